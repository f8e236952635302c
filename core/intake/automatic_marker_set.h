#pragma once

#include <string>
#include <vector>

#include "core/data/marker_set.h"
#include "core/data/marker_trajectories.h"
#include "core/data/model_spec.h"
#include "core/intake/marker_names.h"

namespace gaitmill {

/// What an automatic marker set is made from. Keeps references.
struct AutomaticSetInput {
  const MarkerMapping& mapping;  ///< of the markers of all trials
  const std::vector<MarkerTrajectories>& static_poses;
  const MarkerTrajectories& movement;  ///< may be empty
  const ModelSpec& model;              ///< generic
  double height = 0;                   ///< [m] of the subject; 0 = unknown
  bool symmetric = true;               ///< both sides share one factor, the mean
  double model_height = 1.70;          ///< [m] (Rajagopal et al. 2016, II-D)
};

/// A marker set and what was decided to get there.
struct AutomaticMarkerSet {
  MarkerSetSpec set;
  std::vector<std::string> notes;     ///< how segments are measured where the best way was missing
  std::vector<std::string> warnings;  ///< of the static trials, of markers that are not used
};

/// Makes the marker set of any trial whose markers are known landmarks: they sit on the model where
/// the catalogue has them, under their measured names; segments are measured by the lines of
/// measurementLines() in their order; placements trust bony places and joint centres
/// ((12 mm / placement deviation)^2) and leave clusters out, which move to where they were
/// measured; inverse kinematics trusts markers by how little the skin moves under them. Any heading
/// is allowed. Coordinates of segments that few markers show are held near their default.
/// @throws Error kInputMarkers if a static trial is empty or shows no landmark
AutomaticMarkerSet makeAutomaticMarkerSet(const AutomaticSetInput& input);

}  // namespace gaitmill

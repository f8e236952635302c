#pragma once

#include <string>
#include <vector>

#include "core/data/marker_set.h"
#include "core/data/marker_trajectories.h"
#include "core/data/model_spec.h"
#include "core/intake/marker_names.h"

namespace gaitmill {

/// A marker without a landmark that moves with one segment.
struct RigidMarker {
  std::string measured;
  std::string body;      ///< of the catalogue: "femur_r"
  double deviation = 0;  ///< largest standard deviation of its distances to that body's markers [m]
};

/// Largest deviation of a marker that counts as rigid [m]: skin moves by 10 to 30 mm under thigh
/// clusters in gait (Leardini et al. 2005, Gait Posture 21:212), most of it common to neighbours.
inline constexpr double kRigidDeviation = 0.012;

/// Finds the segment of each marker that the mapping has no landmark for: the one to at least two
/// of whose markers its distances stay constant over all recordings, if no other segment is nearly
/// as good (half as much again). Needs at least twenty frames and some movement between segments;
/// markers without a label and results of other software are left alone.
std::vector<RigidMarker> findRigidMarkers(const std::vector<const MarkerTrajectories*>& recordings,
                                          const MarkerMapping& mapping);

/// Adds these markers to a set: on their body, movable, so that the static pose puts them where
/// they were measured, without a say in that pose and with a small one in inverse kinematics (a
/// tenth of the mean weight). Those whose body the model does not have are left out.
/// @returns a sentence for each that was added
std::vector<std::string> addRigidMarkers(const std::vector<RigidMarker>& markers,
                                         const ModelSpec& model,
                                         const MarkerMapping& mapping,
                                         MarkerSetSpec& set);

}  // namespace gaitmill

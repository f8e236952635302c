#pragma once

#include <string>
#include <vector>

#include "core/analysis/emg_channels.h"
#include "core/analysis/emg_envelope.h"
#include "core/analysis/gait.h"
#include "core/data/marker_set.h"
#include "core/data/marker_trajectories.h"
#include "core/pipeline/intake.h"

namespace gaitmill {

// What can be told of the files of a trial before anything is computed.

/// Measured markers against one marker set.
struct MarkerMatch {
  std::string marker_set;            ///< its name
  std::vector<std::string> found;    ///< that its inverse kinematics weighs, in its order
  std::vector<std::string> missing;  ///< of these, not measured
};

/// One match per set, the one with the largest share of its markers found first.
std::vector<MarkerMatch> matchMarkers(const std::vector<std::string>& measured,
                                      const std::vector<MarkerSetSpec>& sets);

/// The marker sets that ship with the models, by name. @throws Error of readMarkerSet
std::vector<MarkerSetSpec> readShippedMarkerSets(const std::string& models_folder);

/// Which foot stands where and when, for column families that name a foot and for numbered plates,
/// whose feet the markers tell, as a job with default settings takes it.
/// @param forces    in ground
/// @param markers   the movement in ground, or empty (no frames) if it is not there
/// @param warnings  gets sentences on the force table
/// @throws Error kGrfColumns, kGrfValue, kGrfUnits as selectForces
Gait understandForces(ForceReading forces,
                      const MarkerTrajectories& markers,
                      std::vector<std::string>& warnings);

/// The same of a recording without forces.
Gait understandMovement(const MarkerTrajectories& markers);

struct EmgUnderstanding {
  EmgSource source = EmgSource::kEnvelope;  ///< kRaw or kEnvelope
  std::vector<EmgChannel> channels;         ///< with muscles of the project's own model
  std::vector<std::string> warnings;        ///< names of channels that nobody knows
};

/// What a job with default settings takes a recording of EMG for.
/// @throws Error kInputValue below two rows
EmgUnderstanding understandEmg(const TimeSeries& recording);

}  // namespace gaitmill

#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/data/marker_trajectories.h"
#include "core/model/model.h"
#include "core/scale/scale_options.h"
#include "core/scale/scale_result.h"

namespace gaitmill {

/// Rows from the last one at or before the start of the range to the first one at or after its end
/// (spec/scale.md 1). @throws Error kInputTimeRange if the recording does not meet the range
struct FrameRange {
  int first = 0;
  int last = 0;
};
FrameRange findFrameRange(const std::vector<double>& time, const TimeRange& range);

/// Factors from measured marker distances and from manual values.
struct ScaleFactors {
  std::vector<BodyScale>
      bodies;  ///< one per body, in model order; size ratio where nothing was said
  std::vector<MeasurementResult> measurements;
  std::vector<std::string> warnings;
};

/// Factor of a pair = mean measured distance / distance in the model's default pose; of a
/// measurement = mean over its pairs; later ones overwrite earlier ones axis by axis
/// (spec/scale.md 1). A frame in which a marker is missing is left out of the mean of its pairs;
/// OpenSim would drop the measurement.
/// @param model  with the laboratory's markers
/// @param fitted_pose  (n_coordinates) pose of the static trial, for measurements that ask for it
/// @throws Error kInputMarkers if a required pair cannot be measured (unknown marker, visible in
///   too few frames), kModelReference for an unknown body
ScaleFactors calcScaleFactors(const Model& model,
                              const MarkerTrajectories& trial,
                              const ScaleOptions& options,
                              const std::optional<Eigen::VectorXd>& fitted_pose = {});

}  // namespace gaitmill

#pragma once

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

/// The model as it stands between two rounds of scaling and fitting.
struct FittedModel {
  const Model& model;  ///< scaled by `factors`, with the same markers
  Eigen::VectorXd q;   ///< (n_coordinates) fitted to the static trial
  const std::vector<BodyScale>& factors;
};

/// Factor of a pair = mean measured distance / distance in the model's default pose; of a
/// measurement = mean over its pairs; later ones overwrite earlier ones axis by axis
/// (spec/scale.md 1). A frame in which a marker is missing is left out of the mean of its pairs;
/// OpenSim would drop the measurement.
/// @param model  with the laboratory's markers
/// A measurement in the fitted pose gives the factor that its bodies have, times measured distance
/// / distance in the scaled and fitted model: where that stands still the two agree, also when a
/// pair spans bodies that other measurements size. (Distances of the unscaled model in the fitted
/// pose, spec/scale.md 7, would give a thigh measured from the pelvis part of the pelvis' factor.)
/// @param fitted  for measurements in the fitted pose; without it they take the default pose
/// @throws Error kInputMarkers if a required pair cannot be measured (unknown marker, visible in
///   too few frames), kModelReference for an unknown body
ScaleFactors calcScaleFactors(const Model& model,
                              const MarkerTrajectories& trial,
                              const ScaleOptions& options,
                              const FittedModel* fitted = nullptr);

}  // namespace gaitmill

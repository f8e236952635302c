#pragma once

#include <vector>

#include "core/data/marker_trajectories.h"
#include "core/data/model_spec.h"
#include "core/scale/scale_factors.h"
#include "core/scale/scale_options.h"
#include "core/scale/scale_result.h"

namespace gaitmill {

/// Makes a subject's model from a generic one and static poses: factors from marker distances and
/// manual values, the stretched model, its mass, and its markers placed on one pose after the other
/// (spec/scale.md). Where measurements are to be taken in the fitted pose, scaling and fitting
/// repeat until the factors change by less than 1e-4 (spec/scale.md 7). Strength is a step of its
/// own, after residual reduction: see strength.h.
class ScaleSolver {
 public:
  /// @throws Error kInputValue
  ScaleSolver(ModelSpec generic, ScaleOptions options);

  /// @param static_poses  the first one is measured; pose i serves placement i. Placements beyond
  ///   the poses given are left out with a warning.
  /// @throws Error kInputMissing without a pose where one is needed, kInputMarkers,
  ///   kInputTimeRange, kModelReference
  ScaleResult solve(const std::vector<MarkerTrajectories>& static_poses) const;

 private:
  void stretchModel(const std::vector<MarkerTrajectories>& static_poses, ScaleResult& result) const;
  ScaleFactors findFactors(const MarkerTrajectories& pose, ScaleResult& result) const;
  void place(const std::vector<MarkerTrajectories>& static_poses, ScaleResult& result) const;

  ModelSpec generic_;
  ScaleOptions options_;
};

/// What scaling does to a stretched model whatever gave its factors: total mass, and the muscle
/// parameters that the options override.
void finishSubject(const ScaleOptions& options, ModelSpec& model);

}  // namespace gaitmill

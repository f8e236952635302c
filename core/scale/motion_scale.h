#pragma once

#include "core/base/progress.h"
#include "core/data/marker_trajectories.h"
#include "core/data/model_spec.h"
#include "core/scale/motion_scale_options.h"
#include "core/scale/scale_options.h"
#include "core/scale/scale_result.h"

namespace gaitmill {

/// Makes a subject's model without a static trial: body sizes, offsets of the movable markers and
/// the poses of some frames of the motion are fitted together, sizes held near what the subject's
/// height lets expect and offsets near the generic places of the markers (the most probable model;
/// after Andersen et al. 2010, Comput Methods Biomech Biomed Engin 13:171, Lund et al. 2015, Int
/// Biomech 2:1, and Werling et al. 2023, PLoS ONE 18:e0295152). Where the set does not say how far
/// a marker may be from its place, one that it uses to measure or place a segment is taken for a
/// palpated landmark, any other for one of a cluster.
/// Markers that are fixed in the set stay at their generic place on the stretched model.
/// What takes a static trial stays out of reach: a segment whose ends carry no landmark keeps the
/// size that height lets expect.
class MotionScaleSolver {
 public:
  /// @param options  its measurements, manual factors and placements are not applied
  /// @throws Error kInputValue, kModelReference
  MotionScaleSolver(ModelSpec generic, ScaleOptions options, MotionScaleOptions motion);

  /// Some seconds. @throws Error kInputMarkers, kInputTimeRange, kCancelled
  ScaleResult solve(const MarkerTrajectories& trial, const Progress& progress = {}) const;

 private:
  ModelSpec generic_;
  ScaleOptions options_;
  MotionScaleOptions motion_;
};

}  // namespace gaitmill

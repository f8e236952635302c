#pragma once

#include "core/data/marker_set.h"
#include "core/model/marker_fit.h"

namespace gaitmill {

/// What inverse kinematics is asked for (spec/ik.md).
struct IkOptions {
  FitTasks tasks;        ///< markers with weights, coordinate tasks, replaced ranges
  TimeRange range;       ///< frames nearest to both ends, inclusive [s]
  MarkerFitOptions fit;  ///< tolerances of one frame

  // Guidance of the field; beyond it the result carries a warning (spec/ik.md 3).
  double warn_rms = 0.02;  ///< [m] over the visible markers of a frame
  double warn_max = 0.04;  ///< [m] of a single marker

  /// @throws Error kInputValue naming the first option out of range
  void validate() const;
};

}  // namespace gaitmill

#pragma once

#include "core/data/time_series.h"

namespace gaitmill {

/// Generalized forces of a motion, one row per instant of the motion inside the time range.
struct IdResult {
  /// tau of every coordinate on the unconstrained tree, in model order: "<coordinate>_moment" [N.m]
  /// where it rotates, "<coordinate>_force" where it translates or is coupled. Then, for every
  /// coupler, what an actuator on the independent coordinate alone must supply:
  /// "<independent>_moment _with_<dependent>", tau + slope tau_dependent (spec/id.md 1).
  TimeSeries generalized_forces;

  /// Motion as differentiated: coordinates [rad|m], speeds and accelerations, model order.
  TimeSeries coordinates;
  TimeSeries speeds;
  TimeSeries accelerations;

  /// How far motion and ground reaction contradict each other, whatever the choice of root body:
  /// the wrench that would have to act from nowhere, ground axes, moment about the whole body's
  /// mass center. residual_force_x..z [N], residual_moment_x..z [N.m]. No columns unless exactly
  /// six coordinates connect the tree to the ground.
  TimeSeries residual_wrench;

  double lowpass_cutoff = -1;  ///< [Hz] used; -1 = none
};

}  // namespace gaitmill

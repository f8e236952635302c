#pragma once

#include <vector>

#include "core/data/time_series.h"

namespace gaitmill {

/// Smooth muscle activity of the right leg in walking, made up: for each of the ten channels of the
/// published trial (SOL, GAS, TA, MH, BF, VL, VM, RF, GMAX, GMED) a sum of bumps cos^2 at the
/// phases of the gait cycle where such recordings are active, largest value 1, floor 0.02.
/// Dimensionless. They serve to try out the comparison with activations, not to judge it.
/// @param time    [s], right heel strike at 0
/// @param period  [s] of the gait cycle
TimeSeries makeEmgEnvelopes(const std::vector<double>& time, double period);

}  // namespace gaitmill

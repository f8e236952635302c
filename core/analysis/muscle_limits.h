#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/data/time_series.h"

namespace gaitmill {

/// A muscle that is asked for all that it has.
struct Saturation {
  std::string muscle;
  double longest_span = 0;  ///< [s] the longest time without a break at or above the level
};

/// The longest uninterrupted time that each muscle's control stays at or above a level, in the
/// order of `muscles`. Rows may be spaced unevenly; a span runs from its first to its last row.
/// @throws Error kTableUnknownLabel, kTableNoRows
std::vector<Saturation> calcSaturation(const TimeSeries& controls,
                                       const std::vector<std::string>& muscles,
                                       double level);

/// The lengths that a muscle's fibers work at.
struct FiberRange {
  std::string muscle;
  double shortest;          ///< [l0M]
  double longest;           ///< [l0M]
  double outside_fraction;  ///< of the muscle's active impulse that is given outside the range
  double impulse_share;     ///< the same impulse, of the active impulse of all muscles together
};

/// Where in the fibers' range muscles give their active force. Impulses are time integrals of
/// active force by the trapezoid; negative force does not count.
/// @param norm_lengths   one column per muscle [l0M]
/// @param active_forces  the same columns and rows [N]
/// @param low, high      the range [l0M]
/// @throws Error kTableNoRows
std::vector<FiberRange> calcFiberRanges(const TimeSeries& norm_lengths,
                                        const TimeSeries& active_forces,
                                        double low,
                                        double high);

}  // namespace gaitmill

#pragma once

#include <optional>
#include <vector>

#include "core/math/events.h"

namespace gaitmill {

/// 100 (t - start) / (end - start); below 0 before the cycle, above 100 after it.
double calcPercent(const GaitCycle& cycle, double time);
/// The inverse [s].
double calcCycleTime(const GaitCycle& cycle, double percent);

/// A whole percent of the cycle and the instant it is read at, which may lie one cycle later.
struct CycleSample {
  double percent = 0;  ///< 0..100
  double time = 0;     ///< [s]
};

/// The whole percents at which two curves are compared, in the order of time (spec/paper_metrics.md
/// C). A record that covers the cycle from its start gives 0..100. One that starts later is
/// realigned at the seam s: s..100, then 0..s read one cycle later, so that s and 0/100 occur twice
/// (102 samples for the published walking trial, s = 25). Samples outside the record are left out,
/// never extrapolated.
/// @param first_time, last_time  what the record covers [s]
/// @param seam_percent           s in 0..100; by default the first whole percent that is covered
/// @throws Error kInputTimeRange if the cycle has no length
std::vector<CycleSample> makeComparisonGrid(const GaitCycle& cycle,
                                            double first_time,
                                            double last_time,
                                            std::optional<int> seam_percent = std::nullopt);

}  // namespace gaitmill

#pragma once

#include <optional>
#include <vector>

#include "core/analysis/muscle_analysis.h"
#include "core/data/time_series.h"
#include "core/math/events.h"

namespace gaitmill {

/// Rows of a table inside an interval, with rows interpolated at both ends.
/// @throws Error kTableNoRows
TimeSeries cutInterval(const TimeSeries& table, double start, double end);

/// Work given off and taken up [J].
struct SignedWork {
  double positive = 0;  ///< >= 0
  double negative = 0;  ///< <= 0
};
/// Integral over time of the positive and of the negative part of a column [W], linear between
/// rows.
SignedWork integratePower(const TimeSeries& powers, int column);

/// The stretch of a record that is one whole cycle: the cycle itself, or, where the record starts
/// inside it, as much time from there on. Empty if the record ends earlier, to 1 ms.
std::optional<GaitCycle> findCoveredCycle(const GaitCycle& cycle,
                                          double first_time,
                                          double last_time);

/// Work of every muscle over each cycle that the record covers, one row each, its time the cycle's
/// start: <muscle>_fiber_positive_work, _fiber_negative_work (active and passive together),
/// _tendon_positive_work, _tendon_negative_work and _net_work of the whole muscle-tendon unit [J].
TimeSeries calcMuscleWork(const MuscleAnalysis& muscles, const std::vector<GaitCycle>& cycles);

}  // namespace gaitmill

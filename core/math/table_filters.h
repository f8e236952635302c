#pragma once

#include "core/data/time_series.h"

namespace gaitmill {

// Preparation of coordinate tables as residual reduction, CMC, inverse dynamics and static
// optimization do it (spec/signal.md 4, 5).

/// Adds `count` rows at each end by odd (point) reflection of every column and of the time:
///   x_-k = 2 x_0 - x_k. Fewer if the table is shorter. @throws Error kTableNoRows under two rows
TimeSeries padOdd(const TimeSeries& table, int count);

/// Brings the table to a constant step where it has none: if the mean step exceeds the smallest by
/// more than 2^-52 s, values of the quintic spline through the rows, at the smallest step, from the
/// first time on, at most 100000 rows. Otherwise the table as it is. Times printed with few digits
/// nearly always trigger it; the 10 ms tables of the published trials do not.
TimeSeries resampleAtSmallestStep(const TimeSeries& table);

/// Low-pass of residual reduction and CMC: 101 taps, windowed sinc, -6 dB at the cutoff
/// (spec/signal.md 5.2). The ends are reflected by half the taps.
/// @param cutoff  [Hz] > 0
/// @throws Error kTableShape under 100 rows: pad first
TimeSeries filterFir(const TimeSeries& table, double cutoff);

/// Low-pass of inverse dynamics and static optimization: third-order Butterworth forward and
/// backward, -6 dB at the cutoff (spec/signal.md 5.1). A cutoff beyond the Nyquist frequency is
/// lowered to 0.49 of the rate.
/// @param cutoff  [Hz] > 0
TimeSeries filterRecursive(const TimeSeries& table, double cutoff);

/// The table without rows less than `gap` [s] after the last row kept. Simulations write such rows
/// where an event ends a step (1e-13 s apart in the published runs); a spline through both would
/// turn the round-off of their values into accelerations.
TimeSeries dropRepeatedRows(const TimeSeries& table, double gap = 1e-9);

/// Rows whose time lies in [start, end].
TimeSeries cropTime(const TimeSeries& table, double start, double end);

}  // namespace gaitmill

#pragma once

#include <vector>

#include "core/data/time_series.h"
#include "core/rra/rra_result.h"

namespace gaitmill {

/// Empty table of residual sums: force_x..z [N], moment_x..z [N.m].
TimeSeries makeResidualTable(std::vector<double> time);
void setResidualRow(const ResidualSum& sum, int row, TimeSeries& table);

/// Average (trapezoid over time), peak and RMS of each component. @throws Error kTableNoRows under
/// two rows
ResidualStatistics calcResidualStatistics(const TimeSeries& table);

/// Largest and root-mean-square deviations; columns in "m" are translations, the others rotations.
TrackingStatistics calcTrackingStatistics(const TimeSeries& errors);

}  // namespace gaitmill

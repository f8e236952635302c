#include "core/rra/residual_statistics.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "core/base/error.h"
#include "core/base/units.h"

namespace gaitmill {
namespace {

constexpr double kCentimetersPerMeter = 100;

ResidualSum toSum(const Eigen::Matrix<double, 1, 6>& row) {
  return {row.head<3>().transpose(), row.tail<3>().transpose()};
}

void raise(double value, double& largest) {
  largest = std::max(largest, value);
}

}  // namespace

TimeSeries makeResidualTable(std::vector<double> time) {
  TimeSeries table =
      makeTimeSeries("Residuals",
                     {"force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z"},
                     std::move(time));
  table.units = {"N", "N", "N", "N.m", "N.m", "N.m"};
  return table;
}

void setResidualRow(const ResidualSum& sum, int row, TimeSeries& table) {
  table.values.row(row) << sum.force.transpose(), sum.moment.transpose();
}

ResidualStatistics calcResidualStatistics(const TimeSeries& table) {
  require(table.rowCount() >= 2, ErrorCode::kTableNoRows, "residuals of fewer than two instants");
  Eigen::Matrix<double, 1, 6> integral = Eigen::Matrix<double, 1, 6>::Zero();
  for (int i = 1; i < table.rowCount(); ++i) {
    const auto t = static_cast<std::size_t>(i);
    const double step = table.time[t] - table.time[t - 1];
    integral += 0.5 * step * (table.values.row(i - 1) + table.values.row(i));
  }
  ResidualStatistics statistics;
  statistics.average = toSum(integral / (table.time.back() - table.time.front()));
  statistics.peak = toSum(table.values.cwiseAbs().colwise().maxCoeff());
  statistics.rms =
      toSum((table.values.array().square().colwise().sum() / table.rowCount()).sqrt().matrix());
  return statistics;
}

TrackingStatistics calcTrackingStatistics(const TimeSeries& errors) {
  require(errors.rowCount() > 0, ErrorCode::kTableNoRows, "tracking errors without rows");
  TrackingStatistics statistics;
  for (int c = 0; c < errors.columnCount(); ++c) {
    const auto i = static_cast<std::size_t>(c);
    const bool translation = errors.units[i] == "m";
    const double unit = translation ? kCentimetersPerMeter : kDegreesPerRadian;
    const double peak = unit * errors.values.col(c).cwiseAbs().maxCoeff();
    const double rms = unit * std::sqrt(errors.values.col(c).squaredNorm() / errors.rowCount());
    double& largest = translation ? statistics.max_cm : statistics.max_deg;
    std::string& worst = translation ? statistics.worst_translation : statistics.worst_rotation;
    if (peak > largest) worst = errors.labels[i];
    raise(peak, largest);
    raise(rms, translation ? statistics.max_rms_cm : statistics.max_rms_deg);
  }
  return statistics;
}

}  // namespace gaitmill

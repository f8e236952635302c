#include "core/analysis/tracking_error.h"

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/base/error.h"
#include "core/base/units.h"

namespace gaitmill {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

bool isTranslation(const TimeSeries& table, int column) {
  const auto index = static_cast<std::size_t>(column);
  if (!table.units.empty()) {
    return table.units[index] == "m";
  }
  const std::string& label = table.labels[index];
  const std::string suffix = label.size() < 3 ? "" : label.substr(label.size() - 3);
  return suffix == "_tx" || suffix == "_ty" || suffix == "_tz";
}

// NaN loses against any number.
void keepLarger(double value, const std::string& label, double& largest, std::string& worst) {
  if (std::isnan(largest) || value > largest) {
    largest = value;
    worst = label;
  }
}

}  // namespace

TrackingError calcTrackingError(const TimeSeries& errors) {
  require(
      errors.rowCount() > 0, ErrorCode::kTableNoRows, "table '" + errors.name + "' has no rows");
  TrackingError result{kNan, kNan, kNan, kNan, kNan, "", ""};
  double max_rotation = kNan, max_translation = kNan, rms_rotation = kNan, rms_translation = kNan;
  for (int column = 0; column < errors.columnCount(); ++column) {
    const bool is_translation = isTranslation(errors, column);
    const double largest = errors.values.col(column).cwiseAbs().maxCoeff();
    const double rms = std::sqrt(errors.values.col(column).squaredNorm() / errors.rowCount());
    const std::string& label = errors.labels[static_cast<std::size_t>(column)];
    if (is_translation) {
      keepLarger(rms, label, rms_translation, result.worst_translation);
      keepLarger(largest, label, max_translation, result.worst_peak_translation);
    } else {
      keepLarger(rms, label, rms_rotation, result.worst_rotation);
      keepLarger(largest, label, max_rotation, result.worst_peak_rotation);
    }
  }
  result.max_deg = toDegrees(max_rotation);
  result.max_cm = 100.0 * max_translation;
  result.max_rms_deg = toDegrees(rms_rotation);
  result.max_rms_centiradian = 100.0 * rms_rotation;
  result.max_rms_cm = 100.0 * rms_translation;
  return result;
}

TimeSeries calcDifference(const TimeSeries& reference, const TimeSeries& actual) {
  std::vector<std::string> labels;
  std::vector<std::string> units;
  std::vector<int> reference_columns;
  std::vector<int> actual_columns;
  for (int column = 0; column < actual.columnCount(); ++column) {
    const auto index = static_cast<std::size_t>(column);
    if (const std::optional<int> found = reference.findColumn(actual.labels[index])) {
      labels.push_back(actual.labels[index]);
      actual_columns.push_back(column);
      reference_columns.push_back(*found);
      if (!actual.units.empty()) {
        units.push_back(actual.units[index]);
      }
    }
  }
  std::vector<int> rows;
  std::vector<double> time;
  for (int row = 0; row < actual.rowCount() && reference.rowCount() > 0; ++row) {
    const double t = actual.time[static_cast<std::size_t>(row)];
    if (t >= reference.time.front() && t <= reference.time.back()) {
      rows.push_back(row);
      time.push_back(t);
    }
  }
  TimeSeries difference = makeTimeSeries(actual.name, labels, time);
  difference.units = units;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Eigen::VectorXd desired = reference.interpolate(time[i]);
    for (std::size_t j = 0; j < labels.size(); ++j) {
      difference.values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          desired[reference_columns[j]] - actual.values(rows[i], actual_columns[j]);
    }
  }
  return difference;
}

}  // namespace gaitmill

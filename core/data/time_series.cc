#include "core/data/time_series.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>

#include "core/base/error.h"

namespace gaitmill {

std::optional<int> TimeSeries::findColumn(const std::string& label) const {
  const auto found = std::find(labels.begin(), labels.end(), label);
  if (found == labels.end()) {
    return std::nullopt;
  }
  return static_cast<int>(std::distance(labels.begin(), found));
}

int TimeSeries::getColumn(const std::string& label) const {
  const std::optional<int> column = findColumn(label);
  if (!column) {
    const std::string nearest = findNearestName(label, labels);
    throw Error(ErrorCode::kTableUnknownLabel,
                "table '" + name + "' has no column '" + label + "'" +
                    (nearest.empty() ? "" : "; the nearest is '" + nearest + "'"),
                {{}, 0, 0, label});
  }
  return *column;
}

int TimeSeries::findNearestRow(double t) const {
  require(!time.empty(), ErrorCode::kTableNoRows, "table '" + name + "' has no rows");
  const auto after = std::lower_bound(time.begin(), time.end(), t);
  if (after == time.begin()) {
    return 0;
  }
  if (after == time.end()) {
    return rowCount() - 1;
  }
  const auto row = static_cast<int>(std::distance(time.begin(), after));
  return (t - *std::prev(after) <= *after - t) ? row - 1 : row;
}

TimeSeries TimeSeries::copyRows(int first, int last) const {
  check(first >= 0 && first <= last && last < rowCount(),
        "TimeSeries::copyRows: rows out of range");
  TimeSeries part{name, labels, units, {}, {}};
  part.time.assign(time.begin() + first, time.begin() + last + 1);
  part.values = values.middleRows(first, last - first + 1);
  return part;
}

Eigen::VectorXd TimeSeries::interpolate(double t) const {
  require(!time.empty(), ErrorCode::kTableNoRows, "table '" + name + "' has no rows");
  if (t <= time.front()) {
    return values.row(0).transpose();
  }
  if (t >= time.back()) {
    return values.row(rowCount() - 1).transpose();
  }
  const auto after = std::upper_bound(time.begin(), time.end(), t);
  const auto row = static_cast<int>(std::distance(time.begin(), after));
  const double t0 = time[static_cast<std::size_t>(row - 1)];
  const double fraction = (t - t0) / (*after - t0);
  return ((1.0 - fraction) * values.row(row - 1) + fraction * values.row(row)).transpose();
}

TimeSeries makeTimeSeries(std::string name,
                          std::vector<std::string> labels,
                          std::vector<double> time) {
  TimeSeries table{std::move(name), std::move(labels), {}, std::move(time), {}};
  table.values = RowMatrix::Constant(
      table.rowCount(), table.columnCount(), std::numeric_limits<double>::quiet_NaN());
  return table;
}

}  // namespace gaitmill

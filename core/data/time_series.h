#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace gaitmill {

/// Rows in time order, one double per label and row. The matrix is row-major so that one instant is
/// contiguous.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A table over time: SI units and radians, NaN = not measured. The currency between files, stages
/// and results. Times are non-decreasing. `units` is either empty or parallel to `labels`
/// ("rad", "m", "N", "N.m", "" = dimensionless).
struct TimeSeries {
  std::string name;
  std::vector<std::string> labels;  ///< without "time"
  std::vector<std::string> units;
  std::vector<double> time;  ///< [s]
  RowMatrix values;          ///< (time.size() x labels.size())

  int rowCount() const { return static_cast<int>(time.size()); }
  int columnCount() const { return static_cast<int>(labels.size()); }

  /// Column of a label, or nullopt. Linear search; resolve once, not per row.
  std::optional<int> findColumn(const std::string& label) const;

  /// @throws Error kTableUnknownLabel naming the label, the table and the nearest label there is
  int getColumn(const std::string& label) const;

  /// Row with the time nearest to `t`. @throws Error kTableNoRows if there are no rows
  int findNearestRow(double t) const;

  /// Rows first..last inclusive as a table of their own. Requires 0 <= first <= last < rowCount().
  TimeSeries copyRows(int first, int last) const;

  /// Row `t` by linear interpolation; times outside the table give its end rows.
  Eigen::VectorXd interpolate(double t) const;
};

/// An empty table of the given shape, values NaN, so that an unfilled cell cannot pass for an
/// answer.
TimeSeries makeTimeSeries(std::string name,
                          std::vector<std::string> labels,
                          std::vector<double> time);

}  // namespace gaitmill

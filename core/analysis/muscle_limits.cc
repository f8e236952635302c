#include "core/analysis/muscle_limits.h"

#include <algorithm>
#include <cstddef>

#include "core/base/error.h"

namespace gaitmill {

namespace {

double findLongestSpan(const TimeSeries& controls, int column, double level) {
  double longest = 0;
  int first = -1;
  for (int row = 0; row < controls.rowCount(); ++row) {
    if (controls.values(row, column) < level) {
      first = -1;
      continue;
    }
    first = first < 0 ? row : first;
    longest = std::max(longest,
                       controls.time[static_cast<std::size_t>(row)] -
                           controls.time[static_cast<std::size_t>(first)]);
  }
  return longest;
}

// Half of the time to the row before and half of that to the row after: the trapezoid's weights.
std::vector<double> calcRowDurations(const std::vector<double>& time) {
  std::vector<double> durations(time.size(), 0.0);
  for (std::size_t row = 1; row < time.size(); ++row) {
    const double half = 0.5 * (time[row] - time[row - 1]);
    durations[row - 1] += half;
    durations[row] += half;
  }
  return durations;
}

double divide(double part, double whole) {
  return whole > 0 ? part / whole : 0.0;
}

}  // namespace

std::vector<Saturation> calcSaturation(const TimeSeries& controls,
                                       const std::vector<std::string>& muscles,
                                       double level) {
  require(controls.rowCount() > 0, ErrorCode::kTableNoRows, "there are no controls to judge");
  std::vector<Saturation> found;
  for (const std::string& muscle : muscles) {
    found.push_back({muscle, findLongestSpan(controls, controls.getColumn(muscle), level)});
  }
  return found;
}

std::vector<FiberRange> calcFiberRanges(const TimeSeries& norm_lengths,
                                        const TimeSeries& active_forces,
                                        double low,
                                        double high) {
  require(norm_lengths.rowCount() > 0, ErrorCode::kTableNoRows, "there are no fibers to judge");
  check(norm_lengths.labels == active_forces.labels &&
            norm_lengths.rowCount() == active_forces.rowCount(),
        "lengths and forces are of the same muscles and rows");
  const std::vector<double> durations = calcRowDurations(norm_lengths.time);
  std::vector<FiberRange> ranges;
  double all = 0;
  for (int column = 0; column < norm_lengths.columnCount(); ++column) {
    double impulse = 0;
    double outside = 0;
    for (int row = 0; row < norm_lengths.rowCount(); ++row) {
      const double length = norm_lengths.values(row, column);
      const double part = std::max(active_forces.values(row, column), 0.0) *
                          durations[static_cast<std::size_t>(row)];
      impulse += part;
      outside += length < low || length > high ? part : 0.0;
    }
    all += impulse;
    const auto lengths = norm_lengths.values.col(column);
    ranges.push_back({norm_lengths.labels[static_cast<std::size_t>(column)],
                      lengths.minCoeff(),
                      lengths.maxCoeff(),
                      divide(outside, impulse),
                      outside});
  }
  for (FiberRange& range : ranges) {
    range.impulse_share = divide(range.impulse_share, all);
  }
  return ranges;
}

}  // namespace gaitmill

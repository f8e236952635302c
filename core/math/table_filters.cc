#include "core/math/table_filters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/math/natural_spline.h"

namespace gaitmill {
namespace {

constexpr int kFirHalfWidth = 50;
constexpr int kFirMinimumRows = 100;
constexpr int kMaxResampledRows = 100000;

double calcSmallestStep(const std::vector<double>& time) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < time.size(); ++i)
    smallest = std::min(smallest, time[i] - time[i - 1]);
  return smallest;
}

void requireRows(const TimeSeries& table) {
  require(table.rowCount() >= 2, ErrorCode::kTableNoRows, "table has fewer than two rows");
}

void requireCutoff(double cutoff) {
  require(cutoff > 0, ErrorCode::kInputValue, "filter cutoff must be above 0 Hz");
}

// Row `i` of the odd reflection of the rows beyond both ends.
template <class Row>
void setReflected(const RowMatrix& values, Eigen::Index i, Row&& out) {
  const Eigen::Index last = values.rows() - 1;
  if (i < 0) {
    out = 2 * values.row(0) - values.row(-i);
  } else if (i > last) {
    out = 2 * values.row(last) - values.row(2 * last - i);
  } else {
    out = values.row(i);
  }
}

std::array<double, 2 * kFirHalfWidth + 1> makeFirTaps(double cutoff, double step) {
  std::array<double, 2 * kFirHalfWidth + 1> taps{};
  double sum = 0;
  for (int k = -kFirHalfWidth; k <= kFirHalfWidth; ++k) {
    const double x = 2 * kPi * cutoff * k * step;
    const double sinc = k == 0 ? 1 : std::sin(x) / x;
    const double window = 0.54 + 0.46 * std::cos(kPi * k / kFirHalfWidth);  // Hamming
    const double tap = sinc * 2 * cutoff * step * window;
    taps[static_cast<std::size_t>(k + kFirHalfWidth)] = tap;
    sum += tap;
  }
  for (double& tap : taps) tap /= sum;
  return taps;
}

struct ThirdOrderFilter {
  std::array<double, 4> a;  ///< feed-forward
  std::array<double, 4> b;  ///< feedback, b[0] = 1
};

ThirdOrderFilter makeThirdOrder(double cutoff, double step) {
  const double w = std::tan(kPi * cutoff * step);
  const double w2 = w * w;
  const double w3 = w2 * w;
  const double D = (w + 1) * (w2 + w + 1);
  const double gain = w3 / D;
  return {{gain, 3 * gain, 3 * gain, gain},
          {1,
           (3 * w3 + 2 * w2 - 2 * w - 3) / D,
           (3 * w3 - 2 * w2 - 2 * w + 3) / D,
           (w - 1) * (w2 - w + 1) / D}};
}

// One pass over all columns; the first three rows pass unchanged.
RowMatrix runThirdOrder(const ThirdOrderFilter& filter, const RowMatrix& x) {
  RowMatrix y = x;
  for (Eigen::Index k = 3; k < x.rows(); ++k) {
    y.row(k) = filter.a[0] * x.row(k);
    for (int i = 1; i <= 3; ++i) {
      const auto lag = static_cast<std::size_t>(i);
      y.row(k) += filter.a[lag] * x.row(k - i) - filter.b[lag] * y.row(k - i);
    }
  }
  return y;
}

}  // namespace

TimeSeries padOdd(const TimeSeries& table, int count) {
  requireRows(table);
  const int rows = table.rowCount();
  const int pad = std::min(count, rows - 1);
  TimeSeries padded = table;
  padded.time.resize(static_cast<std::size_t>(rows + 2 * pad));
  padded.values.resize(rows + 2 * pad, table.columnCount());
  const auto time = [&](int i) {
    return table.time[static_cast<std::size_t>(i)];
  };
  for (int k = -pad; k < rows + pad; ++k) {
    double t = 0;
    if (k < 0) {
      t = 2 * time(0) - time(-k);
    } else if (k >= rows) {
      t = 2 * time(rows - 1) - time(2 * (rows - 1) - k);
    } else {
      t = time(k);
    }
    padded.time[static_cast<std::size_t>(k + pad)] = t;
    setReflected(table.values, k, padded.values.row(k + pad));
  }
  return padded;
}

TimeSeries resampleAtSmallestStep(const TimeSeries& table) {
  requireRows(table);
  const double span = table.time.back() - table.time.front();
  const double smallest = calcSmallestStep(table.time);
  const double average = span / (table.rowCount() - 1);
  if (average - smallest <= std::numeric_limits<double>::epsilon()) return table;

  const NaturalSpline spline(table.time, table.values, 5);
  const int rows = std::min(static_cast<int>(std::floor(span / smallest)) + 1, kMaxResampledRows);
  TimeSeries resampled = table;
  resampled.time.resize(static_cast<std::size_t>(rows));
  resampled.values.resize(rows, table.columnCount());
  Eigen::VectorXd value(table.columnCount());
  for (int i = 0; i < rows; ++i) {
    const double t = table.time.front() + smallest * i;
    resampled.time[static_cast<std::size_t>(i)] = t;
    spline.evaluate(t, value);
    resampled.values.row(i) = value.transpose();
  }
  return resampled;
}

TimeSeries filterFir(const TimeSeries& table, double cutoff) {
  requireCutoff(cutoff);
  require(
      table.rowCount() >= kFirMinimumRows,
      ErrorCode::kTableShape,
      "low-pass needs at least 100 rows after padding, found " + std::to_string(table.rowCount()));
  TimeSeries filtered = resampleAtSmallestStep(table);
  // The smallest step, as the published results were made with.
  const auto taps = makeFirTaps(cutoff, calcSmallestStep(filtered.time));
  const Eigen::Index rows = filtered.rowCount();
  RowMatrix extended(rows + 2 * kFirHalfWidth, filtered.columnCount());
  for (Eigen::Index i = 0; i < extended.rows(); ++i) {
    setReflected(filtered.values, i - kFirHalfWidth, extended.row(i));
  }
  for (Eigen::Index i = 0; i < rows; ++i) {
    filtered.values.row(i).setZero();
    for (std::size_t k = 0; k < taps.size(); ++k) {
      filtered.values.row(i) += taps[k] * extended.row(i + static_cast<Eigen::Index>(k));
    }
  }
  return filtered;
}

TimeSeries filterRecursive(const TimeSeries& table, double cutoff) {
  requireCutoff(cutoff);
  TimeSeries filtered = resampleAtSmallestStep(table);
  const double step = calcSmallestStep(filtered.time);
  const ThirdOrderFilter filter = makeThirdOrder(std::min(cutoff, 0.49 / step), step);
  filtered.values = runThirdOrder(filter, filtered.values);
  filtered.values = RowMatrix(filtered.values.colwise().reverse());
  filtered.values = runThirdOrder(filter, filtered.values);
  filtered.values = RowMatrix(filtered.values.colwise().reverse());
  return filtered;
}

TimeSeries dropRepeatedRows(const TimeSeries& table, double gap) {
  std::vector<int> kept;
  for (int i = 0; i < table.rowCount(); ++i) {
    const double t = table.time[static_cast<std::size_t>(i)];
    if (kept.empty() || t >= table.time[static_cast<std::size_t>(kept.back())] + gap) {
      kept.push_back(i);
    }
  }
  if (static_cast<int>(kept.size()) == table.rowCount()) return table;
  TimeSeries result = table;
  result.time.resize(kept.size());
  result.values.resize(static_cast<Eigen::Index>(kept.size()), table.columnCount());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    result.time[i] = table.time[static_cast<std::size_t>(kept[i])];
    result.values.row(static_cast<Eigen::Index>(i)) = table.values.row(kept[i]);
  }
  return result;
}

TimeSeries cropTime(const TimeSeries& table, double start, double end) {
  const auto first = std::lower_bound(table.time.begin(), table.time.end(), start);
  const auto last = std::upper_bound(first, table.time.end(), end);
  require(first != last, ErrorCode::kTableNoRows, "no rows in the time range");
  return table.copyRows(static_cast<int>(first - table.time.begin()),
                        static_cast<int>(last - table.time.begin()) - 1);
}

}  // namespace gaitmill

#include "core/figure/ticks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/base/text.h"

namespace gaitmill {

namespace {

double findStep(double span, int ticks) {
  const double raw = span / std::max(ticks, 1);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  constexpr std::array<double, 5> kRound = {1, 2, 2.5, 5, 10};
  for (const double round : kRound) {
    if (round * power >= raw * (1 - 1e-9)) {
      return round * power;
    }
  }
  return 10 * power;
}

class Extent {
 public:
  void add(double value) {
    if (std::isfinite(value)) {
      range_.low = std::min(range_.low, value);
      range_.high = std::max(range_.high, value);
    }
  }
  void add(const std::vector<double>& values) {
    for (const double value : values) {
      add(value);
    }
  }
  Range range() const { return range_.low <= range_.high ? range_ : Range{}; }

 private:
  Range range_{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
};

}  // namespace

Range findRange(const Axis& axis, double data_low, double data_high, int ticks) {
  Range range{axis.low.value_or(data_low), axis.high.value_or(data_high)};
  if (!(range.high > range.low)) {
    const double room = range.low == 0 ? 1 : 0.5 * std::abs(range.low);
    range.high = range.low + room;
    range.low = axis.low ? range.low : range.low - room;
  }
  const double step = findStep(range.high - range.low, ticks);
  if (!axis.low) {
    range.low = step * std::floor(range.low / step + 1e-9);
  }
  if (!axis.high) {
    range.high = step * std::ceil(range.high / step - 1e-9);
  }
  return range;
}

std::vector<double> makeTicks(const Range& range, int ticks) {
  constexpr std::size_t kLeast = 3;
  std::vector<double> values;
  for (int wanted = ticks; values.size() < kLeast && wanted <= ticks + 4; ++wanted) {
    const double step = findStep(range.high - range.low, wanted);
    values.clear();
    for (double n = std::ceil(range.low / step - 1e-9); n * step <= range.high + 1e-9 * step; ++n) {
      values.push_back(n == 0 ? 0 : n * step);
    }
  }
  return values;
}

int countDecimals(const std::vector<double>& ticks) {
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1;
  int decimals = 0;
  while (decimals < 6 && std::abs(step * std::pow(10.0, decimals) -
                                  std::round(step * std::pow(10.0, decimals))) > 1e-6) {
    ++decimals;
  }
  return decimals;
}

std::vector<std::string> labelTicks(const std::vector<double>& ticks) {
  const int decimals = countDecimals(ticks);
  std::vector<std::string> labels;
  for (const double tick : ticks) {
    std::string label = formatFixed(tick, decimals);
    if (label.front() == '-') {
      label.replace(0, 1, "\u2212");
    }
    labels.push_back(label);
  }
  return labels;
}

std::string makeAxisTitle(const Axis& axis) {
  return axis.unit.empty() ? axis.label : axis.label + " [" + axis.unit + "]";
}

Range findDataX(const Panel& panel) {
  Extent extent;
  for (const Series& series : panel.series) {
    extent.add(series.x);
  }
  return extent.range();
}

Range findDataY(const Panel& panel) {
  Extent extent;
  for (const Series& series : panel.series) {
    extent.add(series.y);
    extent.add(series.low);
    if (series.mark == SeriesMark::kBars) {
      extent.add(0.0);
    }
  }
  for (const Guide& guide : panel.guides) {
    if (guide.direction == Guide::Direction::kHorizontal) {
      extent.add(guide.value);
    }
  }
  return extent.range();
}

}  // namespace gaitmill

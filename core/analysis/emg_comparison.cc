#include "core/analysis/emg_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

namespace gaitmill {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kPercents = 100;
// The figures of spec/paper_metrics.md D5.
constexpr double kOnShare = 0.2;
constexpr int kShortestRun = 3;  // [%]
// A correlation over fewer pairs says little of a cycle.
constexpr int kLeastPairs = 80;

/// Values at 0, 1, ... 99 % of the cycle, NaN where the record has none. A circle: 99 is followed
/// by 0.
using Curve = std::array<double, kPercents>;

enum class State { kUnknown, kOff, kOn };
using States = std::array<State, kPercents>;

int wrapIndex(int percent) {
  return ((percent % kPercents) + kPercents) % kPercents;
}
std::size_t at(int percent) {
  return static_cast<std::size_t>(wrapIndex(percent));
}

/// Into [-50, 50).
double wrapDifference(double percent) {
  const double half = 0.5 * kPercents;
  return percent - kPercents * std::floor((percent + half) / kPercents);
}
/// Into [0, 100).
double wrapPercent(double percent) {
  const double wrapped = percent - kPercents * std::floor(percent / kPercents);
  return wrapped >= kPercents ? 0 : wrapped;
}

double calcMeanActivation(const Eigen::VectorXd& row, const std::vector<int>& columns) {
  double sum = 0;
  for (const int column : columns) {
    sum += row[column];
  }
  return sum / static_cast<double>(columns.size());
}

struct Curves {
  Curve emg;
  Curve activation;
};

Curves sampleCurves(const TimeSeries& emg,
                    const TimeSeries& activations,
                    int emg_column,
                    const std::vector<int>& muscle_columns,
                    const GaitCycle& cycle) {
  Curves curves;
  curves.emg.fill(kNaN);
  curves.activation.fill(kNaN);
  for (const CycleSample& sample :
       makeComparisonGrid(cycle,
                          std::max(emg.time.front(), activations.time.front()),
                          std::min(emg.time.back(), activations.time.back()))) {
    const std::size_t i = at(static_cast<int>(std::lround(sample.percent)));
    const double measured = emg.interpolate(sample.time)[emg_column];
    const double simulated =
        calcMeanActivation(activations.interpolate(sample.time), muscle_columns);
    // The seam stands twice: its first reading lies in the cycle itself.
    if (std::isnan(curves.emg[i]) && std::isfinite(measured) && std::isfinite(simulated)) {
      curves.emg[i] = measured;
      curves.activation[i] = simulated;
    }
  }
  return curves;
}

/// Largest value there is; NaN without any.
double findPeak(const Curve& curve) {
  double peak = kNaN;
  for (const double value : curve) {
    peak = std::isnan(value) || value <= peak ? peak : value;
  }
  return peak;
}

/// Neighbouring percents of one state.
struct Run {
  int start = 0;
  int length = 0;
  State state = State::kUnknown;
};

std::vector<Run> findRuns(const States& states) {
  int first = 0;
  while (first < kPercents && states[at(first)] == states[at(first - 1)]) {
    ++first;
  }
  if (first == kPercents) {
    return {{0, kPercents, states[0]}};
  }
  std::vector<Run> runs;
  for (int i = first; i < first + kPercents; ++i) {
    if (i == first || states[at(i)] != runs.back().state) {
      runs.push_back({wrapIndex(i), 0, states[at(i)]});
    }
    ++runs.back().length;
  }
  return runs;
}

/// Turns runs of `state` that are too short to count into `other`, unless they end where the record
/// does.
void absorbShortRuns(State state, State other, States& states) {
  for (const Run& run : findRuns(states)) {
    const bool is_inside =
        states[at(run.start - 1)] == other && states[at(run.start + run.length)] == other;
    if (run.state == state && run.length < kShortestRun && is_inside) {
      for (int i = 0; i < run.length; ++i) {
        states[at(run.start + i)] = other;
      }
    }
  }
}

States findStates(const Curve& curve, double threshold) {
  States states;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    states[i] = std::isnan(curve[i])    ? State::kUnknown
                : curve[i] >= threshold ? State::kOn
                                        : State::kOff;
  }
  absorbShortRuns(State::kOff, State::kOn, states);
  absorbShortRuns(State::kOn, State::kOff, states);
  return states;
}

/// Where the straight line from `outside` to its neighbour `inside` meets the threshold; NaN if the
/// one outside is not known.
double findCrossing(const Curve& curve, double threshold, int outside, int inside) {
  const double below = curve[at(outside)];
  const double above = curve[at(inside)];
  const double share = (threshold - below) / (above - below);
  return wrapPercent(outside + share * (inside - outside));
}

struct BurstRun {
  ActivityBurst burst;
  Run run;
};

std::vector<BurstRun> findBursts(const Curve& curve, const States& states, double threshold) {
  std::vector<BurstRun> bursts;
  for (const Run& run : findRuns(states)) {
    if (run.state != State::kOn) {
      continue;
    }
    const int last = run.start + run.length - 1;
    ActivityBurst burst{kNaN, kNaN};
    if (run.length < kPercents) {
      burst.onset = findCrossing(curve, threshold, run.start - 1, run.start);
      burst.offset = findCrossing(curve, threshold, last + 1, last);
    }
    bursts.push_back({burst, run});
  }
  return bursts;
}

int countCommon(const Run& a, const Run& b) {
  int common = 0;
  for (int i = 0; i < a.length; ++i) {
    common += wrapIndex(a.start + i - b.start) < b.length ? 1 : 0;
  }
  return common;
}

void compareBursts(const std::vector<BurstRun>& measured,
                   const std::vector<BurstRun>& simulated,
                   EmgComparison& result) {
  int most = 0;
  for (const BurstRun& m : measured) {
    result.emg_bursts.push_back(m.burst);
    for (const BurstRun& s : simulated) {
      const int common = countCommon(m.run, s.run);
      if (common > most) {
        most = common;
        result.onset_difference = wrapDifference(s.burst.onset - m.burst.onset);
        result.offset_difference = wrapDifference(s.burst.offset - m.burst.offset);
      }
    }
  }
  for (const BurstRun& s : simulated) {
    result.simulated_bursts.push_back(s.burst);
  }
}

/// Straight lines over gaps that are too short to count: a simulation that ends one percent before
/// the strike still shows when the bursts around the strike begin.
void bridgeShortGaps(Curve& curve) {
  const Curve known = curve;
  for (int i = 0; i < kPercents; ++i) {
    if (!std::isnan(known[at(i)]) || std::isnan(known[at(i - 1)])) {
      continue;
    }
    int length = 1;
    while (length < kShortestRun && std::isnan(known[at(i + length)])) {
      ++length;
    }
    const double start = known[at(i - 1)];
    const double rise = known[at(i + length)] - start;
    for (int k = 0; k < length && length < kShortestRun; ++k) {
      curve[at(i + k)] = start + rise * (k + 1) / (length + 1);
    }
  }
}

void compareTiming(Curves curves, EmgComparison& result) {
  bridgeShortGaps(curves.emg);
  bridgeShortGaps(curves.activation);
  const double emg_threshold = kOnShare * result.emg_peak;
  const double activation_threshold = kOnShare * result.activation_peak;
  const States measured = findStates(curves.emg, emg_threshold);
  const States simulated = findStates(curves.activation, activation_threshold);
  int agreeing = 0;
  int known = 0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    known += measured[i] != State::kUnknown ? 1 : 0;
    agreeing += measured[i] != State::kUnknown && measured[i] == simulated[i] ? 1 : 0;
  }
  result.overlap = agreeing / static_cast<double>(known);
  compareBursts(findBursts(curves.emg, measured, emg_threshold),
                findBursts(curves.activation, simulated, activation_threshold),
                result);
}

/// Pearson's coefficient of the EMG and the activation `lag` percents later; NaN below kLeastPairs.
double calcCorrelation(const Curves& curves, int lag) {
  std::vector<double> x;
  std::vector<double> y;
  for (int i = 0; i < kPercents; ++i) {
    if (!std::isnan(curves.emg[at(i)]) && !std::isnan(curves.activation[at(i + lag)])) {
      x.push_back(curves.emg[at(i)]);
      y.push_back(curves.activation[at(i + lag)]);
    }
  }
  if (x.size() < static_cast<std::size_t>(kLeastPairs)) {
    return kNaN;
  }
  const auto n = static_cast<Eigen::Index>(x.size());
  Eigen::ArrayXd u = Eigen::Map<const Eigen::ArrayXd>(x.data(), n);
  Eigen::ArrayXd v = Eigen::Map<const Eigen::ArrayXd>(y.data(), n);
  u -= u.mean();
  v -= v.mean();
  const double norm = std::sqrt(u.square().sum() * v.square().sum());
  return norm > 0 ? (u * v).sum() / norm : kNaN;
}

void correlate(const Curves& curves, EmgComparison& result) {
  result.correlation_at_zero = calcCorrelation(curves, 0);
  // Small lags first: of equal correlations the nearest one counts.
  for (int size = 0; size <= kPercents / 2; ++size) {
    for (const int lag : {size, -size}) {
      const double correlation = calcCorrelation(curves, lag);
      if (correlation > result.correlation || std::isnan(result.correlation)) {
        result.correlation = correlation;
        result.lag = std::isnan(correlation) ? kNaN : wrapDifference(lag);
      }
    }
  }
}

void compareShapes(const Curves& curves, EmgComparison& result) {
  double sum = 0;
  for (std::size_t i = 0; i < curves.emg.size(); ++i) {
    const double difference = result.scale * curves.emg[i] - curves.activation[i];
    sum += std::isnan(difference) ? 0 : difference * difference;
  }
  result.rms_difference = std::sqrt(sum / result.instants) / result.activation_peak;
}

}  // namespace

EmgComparison compareEmg(const TimeSeries& emg,
                         const TimeSeries& activations,
                         const EmgChannel& channel,
                         const GaitCycle& cycle) {
  EmgComparison result{channel.channel,
                       {},
                       channel.side,
                       0,
                       kNaN,
                       kNaN,
                       kNaN,
                       kNaN,
                       kNaN,
                       {},
                       {},
                       kNaN,
                       kNaN,
                       kNaN,
                       kNaN,
                       kNaN};
  std::vector<int> columns;
  for (const std::string& muscle : channel.muscles) {
    if (const std::optional<int> column = activations.findColumn(muscle)) {
      columns.push_back(*column);
      result.muscles.push_back(muscle);
    }
  }
  if (columns.empty() || emg.rowCount() == 0 || activations.rowCount() == 0) {
    return result;
  }
  const Curves curves = sampleCurves(emg, activations, channel.column, columns, cycle);
  result.instants = static_cast<int>(std::count_if(
      curves.emg.begin(), curves.emg.end(), [](double value) { return !std::isnan(value); }));
  result.emg_peak = findPeak(curves.emg);
  result.activation_peak = findPeak(curves.activation);
  if (!(result.emg_peak > 0) || !(result.activation_peak > 0)) {
    return result;
  }
  result.scale = result.activation_peak / result.emg_peak;
  compareShapes(curves, result);
  compareTiming(curves, result);
  correlate(curves, result);
  return result;
}

}  // namespace gaitmill

#include "core/intake/clock_offset.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/base/text.h"
#include "core/math/filters.h"

namespace gaitmill {

namespace {

constexpr double kLowpass = 8;        // [Hz] steps, without the ringing of soft tissue
constexpr double kLargestLag = 0.15;  // [s]
constexpr double kLagStep = 0.001;    // [s]
constexpr double kMargin = 0.05;      // [s] left out at each end, where filters know least
constexpr int kLeastFrames = 40;
constexpr double kWholeWeight = 0.5;  // of the largest force
constexpr double kClearCorrelation = 0.9;
constexpr double kClearFrames = 0.75;

/// A curve on a uniform grid.
struct Curve {
  double start = 0;
  double step = 0;
  Eigen::VectorXd values;

  double at(double time) const {
    const double place = (time - start) / step;
    const auto i = static_cast<Eigen::Index>(std::floor(place));
    const double share = place - std::floor(place);
    return (1 - share) * values[i] + share * values[i + 1];
  }
  double end() const { return start + step * static_cast<double>(values.size() - 2); }
};

void smooth(Curve& curve) {
  RowMatrix column = curve.values;
  filterZeroPhase(makeButterworthLowPass(2, kLowpass, 1 / curve.step), column);
  curve.values = column.col(0);
}

/// Markers that are seen in every frame, so that none comes and goes.
std::vector<int> findSteadyMarkers(const MarkerTrajectories& markers, const BodyMarkers& body) {
  std::vector<int> steady;
  for (const int marker : body.others) {
    bool is_steady = true;
    for (int frame = 0; frame < markers.frameCount() && is_steady; ++frame) {
      is_steady = !markers.isMissing(frame, marker);
    }
    if (is_steady) {
      steady.push_back(marker);
    }
  }
  return steady;
}

Curve calcAcceleration(const MarkerTrajectories& markers, const std::vector<int>& steady) {
  const int n = markers.frameCount();
  Curve curve;
  curve.start = markers.time.front();
  curve.step = (markers.time.back() - markers.time.front()) / (n - 1);
  Eigen::VectorXd height = Eigen::VectorXd::Zero(n);
  for (const int marker : steady) {
    height +=
        markers.positions.col(Eigen::Index{3} * marker + 1) / static_cast<double>(steady.size());
  }
  curve.values = Eigen::VectorXd::Zero(n);
  for (int i = 1; i + 1 < n; ++i) {
    curve.values[i] = (height[i - 1] - 2 * height[i] + height[i + 1]) / (curve.step * curve.step);
  }
  curve.values[0] = curve.values[1];
  curve.values[n - 1] = curve.values[n - 2];
  smooth(curve);
  return curve;
}

Curve calcVerticalForce(const GroundReaction& reaction) {
  const auto n = static_cast<Eigen::Index>(reaction.time.size());
  Curve curve;
  curve.start = reaction.time.front();
  curve.step = (reaction.time.back() - reaction.time.front()) / static_cast<double>(n - 1);
  curve.values = Eigen::VectorXd::Zero(n);
  for (const ExternalForce& force : reaction.forces) {
    for (Eigen::Index i = 0; i < n; ++i) {
      curve.values[i] += std::isfinite(force.force(1, i)) ? force.force(1, i) : 0;
    }
  }
  smooth(curve);
  return curve;
}

struct Span {
  double first;
  double last;
};

/// The longest time over which somebody's whole weight may be on the plates. Walking beside them
/// for a while leaves forces that the body's acceleration does not follow.
Span findLoadedSpan(const Curve& force) {
  const double least = kWholeWeight * force.values.maxCoeff();
  Span longest{0, 0};
  Eigen::Index begin = 0;
  for (Eigen::Index i = 0; i <= force.values.size(); ++i) {
    if (i < force.values.size() && force.values[i] >= least) {
      continue;
    }
    const Span span{force.start + force.step * static_cast<double>(begin),
                    force.start + force.step * static_cast<double>(i - 1)};
    if (span.last - span.first > longest.last - longest.first) {
      longest = span;
    }
    begin = i + 1;
  }
  return longest;
}

double correlate(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b) {
  const Eigen::ArrayXd x = a - a.mean();
  const Eigen::ArrayXd y = b - b.mean();
  const double scale = std::sqrt(x.square().sum() * y.square().sum());
  return scale > 0 ? (x * y).sum() / scale : 0;
}

/// Correlation over a span of the forces if their times were later by `offset`; nothing if too
/// little is common.
std::optional<double> correlateAt(const Curve& acceleration,
                                  const Curve& force,
                                  const Span& span,
                                  double offset) {
  const double first = std::max(acceleration.start, span.first + offset) + kMargin;
  const double last = std::min(acceleration.end(), span.last + offset) - kMargin;
  const auto count = static_cast<int>(std::floor((last - first) / acceleration.step));
  if (count < kLeastFrames) {
    return std::nullopt;
  }
  Eigen::ArrayXd a(count);
  Eigen::ArrayXd f(count);
  for (int i = 0; i < count; ++i) {
    const double time = first + i * acceleration.step;
    a[i] = acceleration.at(time);
    f[i] = force.at(time - offset);
  }
  return correlate(a, f);
}

void search(const Curve& acceleration, const Curve& force, const Span& span, ClockOffset& found) {
  found = {};
  found.correlation_at_zero = correlateAt(acceleration, force, span, 0).value_or(0);
  const auto lags = static_cast<int>(kLargestLag / kLagStep);
  for (int i = -lags; i <= lags; ++i) {
    const double correlation = correlateAt(acceleration, force, span, i * kLagStep).value_or(0);
    if (correlation > found.correlation) {
      found.correlation = correlation;
      found.offset = i * kLagStep;
    }
  }
}

}  // namespace

ClockOffset findClockOffset(const MarkerTrajectories& markers,
                            const BodyMarkers& body,
                            const GroundReaction& reaction) {
  ClockOffset found;
  const std::vector<int> steady = findSteadyMarkers(markers, body);
  if (steady.empty() || markers.frameCount() < kLeastFrames ||
      reaction.time.size() < kLeastFrames ||
      0.5 / kLowpass <= reaction.time[1] - reaction.time[0]) {
    return found;
  }
  const Curve acceleration = calcAcceleration(markers, steady);
  const Curve force = calcVerticalForce(reaction);
  search(acceleration, force, {force.start, force.end()}, found);
  if (found.correlation < kClearCorrelation) {
    search(acceleration, force, findLoadedSpan(force), found);
  }
  found.is_clear = found.correlation >= kClearCorrelation &&
                   std::abs(found.offset) >= kClearFrames * acceleration.step &&
                   std::abs(found.offset) < kLargestLag - kLagStep / 2;
  return found;
}

void decideClock(const MarkerTrajectories& markers,
                 const BodyMarkers& body,
                 const std::optional<double>& set,
                 GroundReaction& reaction,
                 Decisions& decisions) {
  Decision decision;
  decision.part = "grf";
  decision.topic = "force_time_offset_s";
  decision.field = "trial.force_time_offset_s";
  decision.evidence = "there is no movement to compare with";
  double offset = 0;
  if (set) {
    offset = *set;
    decision.origin = Decision::Origin::kSet;
    decision.evidence = "the settings say so";
  } else if (!reaction.time.empty() && markers.frameCount() > 1) {
    const ClockOffset found = findClockOffset(markers, body, reaction);
    offset = found.is_clear ? found.offset : 0;
    decision.origin = found.is_clear ? Decision::Origin::kDetected : Decision::Origin::kAssumed;
    decision.confidence = found.is_clear ? found.correlation : std::max(0.5, found.correlation);
    decision.evidence = "force and vertical acceleration of the markers correlate by " +
                        formatFixed(found.correlation_at_zero, 3) + " as they are and at most by " +
                        formatFixed(found.correlation, 3) + ", the forces " +
                        formatFixed(found.offset, 3) + " s later";
  }
  if (offset != 0) {
    for (double& time : reaction.time) {
      time += offset;
    }
  }
  decision.value = formatFixed(offset, 4);
  decisions.push_back(decision);
}

}  // namespace gaitmill

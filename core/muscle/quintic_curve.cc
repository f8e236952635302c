#include "core/muscle/quintic_curve.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"

namespace gaitmill {
namespace {

// Slopes closer than sqrt(machine epsilon) have no corner point (spec/muscle.md 3.1).
constexpr double kParallel = 1.49e-8;
// A Newton step below this leaves an error of its square: round-off.
constexpr double kLastStep = 1e-9;
constexpr int kMaxSteps = 60;
// Largest errors of a cell's polynomials, relative to the larger of 1 and the solved value or
// slope, and the cells per segment tried to reach them.
constexpr double kValueError = 2e-14;
constexpr double kSlopeError = 5e-13;
constexpr std::size_t kFewestCells = 16;
constexpr std::size_t kMostCells = 1024;

CurvePoint evaluate(const std::array<double, 6>& p, double u) {
  const double value = ((((p[5] * u + p[4]) * u + p[3]) * u + p[2]) * u + p[1]) * u + p[0];
  const double slope = (((5 * p[5] * u + 4 * p[4]) * u + 3 * p[3]) * u + 2 * p[2]) * u + p[1];
  return {value, slope};
}

// Horner's rule.
template <std::size_t kSize>
double evaluatePowers(const std::array<double, kSize>& p, double t) {
  double value = p[kSize - 1];
  for (std::size_t i = kSize - 1; i-- > 0;) {
    value = value * t + p[i];
  }
  return value;
}

// Powers of u from the control points p0, p1 = p2, p3 = p4, p5.
std::array<double, 6> makePowers(double p0, double p1, double p3, double p5) {
  return {p0,
          5 * (p1 - p0),
          -10 * (p1 - p0),
          10 * (p3 - p0),
          5 * (p0 + 2 * p1 - 3 * p3),
          p5 - p0 - 5 * (p1 - p3)};
}

// Powers of t of the polynomial through values at the given nodes, by divided differences.
template <std::size_t kSize>
std::array<double, kSize> interpolate(const std::array<double, kSize>& nodes,
                                      std::array<double, kSize> values) {
  for (std::size_t order = 1; order < kSize; ++order) {
    for (std::size_t i = kSize - 1; i >= order; --i) {
      values[i] = (values[i] - values[i - 1]) / (nodes[i] - nodes[i - order]);
    }
  }
  std::array<double, kSize> powers = {};
  for (std::size_t i = kSize; i-- > 0;) {
    // powers = powers * (t - node_i) + values_i
    for (std::size_t k = kSize - 1; k > 0; --k) {
      powers[k] = powers[k - 1] - nodes[i] * powers[k];
    }
    powers[0] = values[i] - nodes[i] * powers[0];
  }
  return powers;
}

}  // namespace

QuinticCurve::QuinticCurve(const std::vector<Joint>& joints, const std::vector<double>& tightness) {
  check(joints.size() >= 2 && tightness.size() + 1 == joints.size(), "curve joints and corners");
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
    const Joint& a = joints[i];
    const Joint& b = joints[i + 1];
    const double c = tightness[i];

    // Corner point: where the two end tangents meet.
    const bool parallel = std::abs(a.slope - b.slope) <= kParallel;
    const double corner_x = parallel
                                ? 0.5 * (a.x + b.x)
                                : (b.y - a.y - b.x * b.slope + a.x * a.slope) / (a.slope - b.slope);
    const double corner_y = b.y + b.slope * (corner_x - b.x);
    const double span = std::hypot(b.x - a.x, b.y - a.y);
    require(span > std::hypot(corner_x - a.x, corner_y - a.y) &&
                span > std::hypot(corner_x - b.x, corner_y - b.y),
            ErrorCode::kMuscleParameter,
            "muscle curve parameters give an S-shaped corner");

    Segment segment;
    segment.x = makePowers(a.x, a.x + c * (corner_x - a.x), b.x + c * (corner_x - b.x), b.x);
    segment.y = makePowers(a.y, a.y + c * (corner_y - a.y), b.y + c * (corner_y - b.y), b.y);
    segment.x_start = a.x;
    segment.x_end = b.x;
    segments_.push_back(segment);
  }
  finish(joints.front().slope, joints.back().slope);
  start_.value = joints.front().y;
  end_.value = joints.back().y;
}

QuinticCurve QuinticCurve::makeInverse() const {
  QuinticCurve inverse;
  for (const Segment& segment : segments_) {
    Segment swapped;
    swapped.x = segment.y;
    swapped.y = segment.x;
    swapped.x_start = evaluate(segment.y, 0).value;
    swapped.x_end = evaluate(segment.y, 1).value;
    inverse.segments_.push_back(swapped);
  }
  inverse.finish(1 / start_.slope, 1 / end_.slope);
  inverse.start_.value = startX();
  inverse.end_.value = endX();
  return inverse;
}

void QuinticCurve::finish(double start_slope, double end_slope) {
  start_.slope = start_slope;
  end_.slope = end_slope;
  for (Segment& segment : segments_) {
    makeCells(segment);
  }
}

// Doubles the number of cells until their polynomials meet the curve.
void QuinticCurve::makeCells(Segment& segment) {
  std::vector<Cell> cells;
  for (std::size_t count = kFewestCells; count <= kMostCells; count *= 2) {
    segment.cell_count = count;
    segment.cells_per_x = static_cast<double>(count) / (segment.x_end - segment.x_start);
    if (fitCells(segment, cells) <= 1) {
      break;
    }
  }
  segment.first_cell = cells_.size();
  cells_.insert(cells_.end(), cells.begin(), cells.end());
}

// Interpolates at Chebyshev points of every cell, ends included, so that cells join; returns the
// largest error found half-way between the points, over the allowed one.
double QuinticCurve::fitCells(const Segment& segment, std::vector<Cell>& cells) const {
  Powers nodes;
  for (std::size_t k = 0; k <= kDegree; ++k) {
    nodes[k] = -std::cos(kPi * static_cast<double>(k) / kDegree);
  }
  const auto solveAt = [&](std::size_t cell, double t) {
    const double x =
        segment.x_start + (static_cast<double>(cell) + 0.5 * (t + 1)) / segment.cells_per_x;
    return solve(segment, std::clamp(x, segment.x_start, segment.x_end));
  };
  double worst = 0;
  cells.resize(segment.cell_count);
  for (std::size_t c = 0; c < segment.cell_count; ++c) {
    Powers values;
    Powers slopes;
    for (std::size_t k = 0; k <= kDegree; ++k) {
      const CurvePoint solved = solveAt(c, nodes[k]);
      values[k] = solved.value;
      slopes[k] = solved.slope;
    }
    cells[c] = {interpolate(nodes, values), interpolate(nodes, slopes)};
    for (std::size_t k = 0; k < kDegree; ++k) {
      const double t = 0.5 * (nodes[k] + nodes[k + 1]);
      const CurvePoint solved = solveAt(c, t);
      const double value_error = std::abs(evaluatePowers(cells[c].value, t) - solved.value);
      const double slope_error = std::abs(evaluatePowers(cells[c].slope, t) - solved.slope);
      worst = std::max({worst,
                        value_error / (kValueError * std::max(1.0, std::abs(solved.value))),
                        slope_error / (kSlopeError * std::max(1.0, std::abs(solved.slope)))});
    }
  }
  return worst;
}

CurvePoint QuinticCurve::solve(const Segment& segment, double x) {
  double low = 0;
  double high = 1;
  double u = (x - segment.x_start) / (segment.x_end - segment.x_start);
  for (int step = 0; step < kMaxSteps; ++step) {
    const CurvePoint at = evaluate(segment.x, u);
    const double error = at.value - x;
    (error > 0 ? high : low) = u;
    double next = u - error / at.slope;
    if (!(next >= low && next <= high)) {
      next = 0.5 * (low + high);
    }
    const double change = std::abs(next - u);
    u = next;
    if (change < kLastStep) {
      break;
    }
  }
  const CurvePoint y = evaluate(segment.y, u);
  return {y.value, y.slope / evaluate(segment.x, u).slope};
}

CurvePoint QuinticCurve::calc(double x) const noexcept {
  if (x < startX()) {
    return {start_.value + start_.slope * (x - startX()), start_.slope};
  }
  for (const Segment& segment : segments_) {
    if (x < segment.x_end) {
      const double position = (x - segment.x_start) * segment.cells_per_x;
      const auto cell = std::min(static_cast<std::size_t>(position), segment.cell_count - 1);
      const double t = 2 * (position - static_cast<double>(cell)) - 1;
      const Cell& powers = cells_[segment.first_cell + cell];
      return {evaluatePowers(powers.value, t), evaluatePowers(powers.slope, t)};
    }
  }
  // Beyond the end, and NaN, which compares false with everything.
  return {end_.value + end_.slope * (x - endX()), std::isnan(x) ? x : end_.slope};
}

CurvePoint QuinticCurve::calcBySolving(double x) const noexcept {
  for (const Segment& segment : segments_) {
    if (x >= segment.x_start && x < segment.x_end) {
      return solve(segment, x);
    }
  }
  return calc(x);
}

}  // namespace gaitmill

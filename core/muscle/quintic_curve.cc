#include "core/muscle/quintic_curve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/error.h"

namespace gaitmill {
namespace {

// Slopes closer than sqrt(machine epsilon) have no corner point (spec/muscle.md 3.1).
constexpr double kParallel = 1.49e-8;
// A Newton step below this leaves an error of its square: round-off.
constexpr double kLastStep = 1e-9;
constexpr int kMaxSteps = 60;

struct Value {
  double value;
  double slope;
};

Value evaluate(const std::array<double, 6>& p, double u) {
  const double value = ((((p[5] * u + p[4]) * u + p[3]) * u + p[2]) * u + p[1]) * u + p[0];
  const double slope = (((5 * p[5] * u + 4 * p[4]) * u + 3 * p[3]) * u + 2 * p[2]) * u + p[1];
  return {value, slope};
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
    segment.cells_per_x = kCells / (segment.x_end - segment.x_start);
    fillSeeds(segment);
  }
}

void QuinticCurve::fillSeeds(Segment& segment) {
  segment.seeds.front() = 0;
  segment.seeds.back() = 1;
  for (std::size_t i = 1; i < kCells; ++i) {
    const double x = segment.x_start + static_cast<double>(i) / segment.cells_per_x;
    segment.seeds[i] = solveParameter(segment, x, segment.seeds[i - 1], {segment.seeds[i - 1], 1});
  }
}

double QuinticCurve::solveParameter(const Segment& segment,
                                    double x,
                                    double guess,
                                    Bracket bracket) {
  double u = guess;
  for (int step = 0; step < kMaxSteps; ++step) {
    const Value at = evaluate(segment.x, u);
    const double error = at.value - x;
    (error > 0 ? bracket.high : bracket.low) = u;
    double next = u - error / at.slope;
    if (!(next >= bracket.low && next <= bracket.high)) {
      next = 0.5 * (bracket.low + bracket.high);
    }
    const double change = std::abs(next - u);
    u = next;
    if (change < kLastStep) {
      break;
    }
  }
  return u;
}

CurvePoint QuinticCurve::calc(double x) const noexcept {
  if (std::isnan(x)) {
    return {x, x};
  }
  if (x < startX()) {
    return {start_.value + start_.slope * (x - startX()), start_.slope};
  }
  for (const Segment& segment : segments_) {
    if (x >= segment.x_end) {
      continue;
    }
    const double position = std::max(0.0, (x - segment.x_start) * segment.cells_per_x);
    const auto cell = std::min(static_cast<std::size_t>(position), std::size_t{kCells - 1});
    const double fraction = position - static_cast<double>(cell);
    const double guess =
        segment.seeds[cell] + fraction * (segment.seeds[cell + 1] - segment.seeds[cell]);
    // One cell more on either side: x may lie a rounding error beyond its cell.
    const Bracket bracket{segment.seeds[cell > 0 ? cell - 1 : 0],
                          segment.seeds[std::min(cell + 2, std::size_t{kCells})]};
    const double u = solveParameter(segment, x, std::min(guess, bracket.high), bracket);
    return {evaluate(segment.y, u).value,
            evaluate(segment.y, u).slope / evaluate(segment.x, u).slope};
  }
  return {end_.value + end_.slope * (x - endX()), end_.slope};
}

}  // namespace gaitmill

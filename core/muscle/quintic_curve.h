#pragma once

#include <array>
#include <vector>

namespace gaitmill {

/// Value and slope of a curve at one abscissa.
struct CurvePoint {
  double value = 0;
  double slope = 0;
};

/// A C2 chain of planar quintic Bezier corners (spec/muscle.md 3.1): x(u), y(u) with 0 <= u <= 1 in
/// each segment, x(u) strictly increasing, straight lines beyond the ends. Immutable, may be shared
/// between threads; evaluation does not allocate. NaN in gives NaN out.
class QuinticCurve {
 public:
  /// Point that the chain passes, with its slope dy/dx.
  struct Joint {
    double x = 0;
    double y = 0;
    double slope = 0;
  };

  /// @param joints    at least two, x strictly increasing
  /// @param tightness [0, 1] of each corner between two joints (c of the spec, not "curviness")
  /// @throws Error kMuscleParameter if a corner would be S-shaped
  QuinticCurve(const std::vector<Joint>& joints, const std::vector<double>& tightness);

  /// Solves x(u) = x by Newton steps inside a bracket, to round-off, then y(u) and dy/dx.
  CurvePoint calc(double x) const noexcept;

  /// The curve with x and y exchanged. Needs y(u) strictly increasing too.
  QuinticCurve makeInverse() const;

  double startX() const { return segments_.front().x_start; }
  double endX() const { return segments_.back().x_end; }

 private:
  static constexpr int kCells = 32;  ///< seeds per segment: 1 to 2 Newton steps remain

  using Quintic = std::array<double, 6>;  ///< coefficients of 1, u .. u^5

  struct Segment {
    double x_start = 0;
    double x_end = 0;
    double cells_per_x = 0;
    Quintic x = {};
    Quintic y = {};
    std::array<double, kCells + 1> seeds = {};  ///< u at equally spaced x
  };

  QuinticCurve() = default;
  void finish(double start_slope, double end_slope);
  static void fillSeeds(Segment& segment);
  struct Bracket {
    double low;
    double high;
  };
  static double solveParameter(const Segment& segment, double x, double guess, Bracket bracket);

  std::vector<Segment> segments_;
  CurvePoint start_;  ///< end values and slopes of the straight continuations
  CurvePoint end_;
};

}  // namespace gaitmill

#pragma once

#include <array>
#include <cstddef>
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
///
/// y(x) has no closed form. The constructor solves x(u) = x at many points and keeps y and dy/dx as
/// polynomials of degree 7 on cells short enough that they agree with the Bezier curve to some
/// 1e-14 (slopes: relative): evaluation then costs a fraction of solving for u, which would
/// dominate muscle simulations. The slope has a polynomial of its own, since the derivative of the
/// value's would carry its rounding divided by the width of the cell.
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

  CurvePoint calc(double x) const noexcept;

  /// The definition: solves x(u) = x by Newton steps inside a bracket, to round-off, then takes
  /// y(u) and dy/dx. For making the cells, and for tests.
  CurvePoint calcBySolving(double x) const noexcept;

  /// The curve with x and y exchanged. Needs y(u) strictly increasing too.
  QuinticCurve makeInverse() const;

  double startX() const { return segments_.front().x_start; }
  double endX() const { return segments_.back().x_end; }

 private:
  static constexpr std::size_t kDegree = 7;
  using Quintic = std::array<double, 6>;           ///< coefficients of 1, u .. u^5
  using Powers = std::array<double, kDegree + 1>;  ///< of 1, t .. t^7, t in [-1, 1] over a cell

  struct Cell {
    Powers value;
    Powers slope;
  };

  struct Segment {
    double x_start = 0;
    double x_end = 0;
    double cells_per_x = 0;
    std::size_t first_cell = 0;
    std::size_t cell_count = 0;
    Quintic x = {};
    Quintic y = {};
  };

  QuinticCurve() = default;
  void finish(double start_slope, double end_slope);
  void makeCells(Segment& segment);
  double fitCells(const Segment& segment, std::vector<Cell>& cells) const;
  static CurvePoint solve(const Segment& segment, double x);

  std::vector<Segment> segments_;
  std::vector<Cell> cells_;  ///< of all segments in turn
  CurvePoint start_;         ///< end values and slopes of the straight continuations
  CurvePoint end_;
};

}  // namespace gaitmill

#pragma once

#include <vector>

#include "core/data/model_spec.h"

namespace gaitmill {

/// A FunctionSpec made ready for evaluation. Immutable, does not allocate after construction.
/// The spline is the cubic with Forsythe-Malcolm-Moler end conditions and linear extrapolation that
/// documents call SimmSpline (spec/model.md 5.2).
class ScalarFunction {
 public:
  /// Value and the first two derivatives at one abscissa.
  struct Sample {
    double value = 0;
    double first = 0;
    double second = 0;
  };

  /// @throws Error kModelValue if knots or coefficients do not define the function
  explicit ScalarFunction(const FunctionSpec& spec);

  Sample evaluate(double x) const;

 private:
  Sample evaluatePolynomial(double x) const;
  Sample evaluatePiecewise(double x) const;

  FunctionSpec::Kind kind_;
  double scale_;
  std::vector<double> x_;
  std::vector<double> y_;  ///< knot values, or polynomial coefficients, highest order first
  /// Taylor coefficients of each interval after the value: slope, half curvature, sixth of the
  /// third.
  std::vector<double> b_, c_, e_;
};

}  // namespace gaitmill

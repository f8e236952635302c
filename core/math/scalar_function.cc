#include "core/math/scalar_function.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "core/base/error.h"

namespace gaitmill {

namespace {

void requireKnots(const FunctionSpec& spec) {
  require(spec.x.size() == spec.y.size() && spec.x.size() >= 2,
          ErrorCode::kModelValue,
          "a spline needs as many abscissae as values, at least 2; found " +
              std::to_string(spec.x.size()) + " and " + std::to_string(spec.y.size()));
  for (std::size_t i = 0; i < spec.x.size(); ++i) {
    require(std::isfinite(spec.x[i]) && std::isfinite(spec.y[i]),
            ErrorCode::kModelValue,
            "knot " + std::to_string(i + 1) + " of a spline is not finite");
    require(i == 0 || spec.x[i] > spec.x[i - 1],
            ErrorCode::kModelValue,
            "spline abscissae must increase; knot " + std::to_string(i + 1) + " does not");
  }
}

/// Third divided difference of four knots from `i`, from the slopes d between them.
double calcThirdDifference(const std::vector<double>& x,
                           const std::vector<double>& d,
                           std::size_t i) {
  return ((d[i + 2] - d[i + 1]) / (x[i + 3] - x[i + 1]) - (d[i + 1] - d[i]) / (x[i + 2] - x[i])) /
         (x[i + 3] - x[i]);
}

/// One sixth of the second derivative at each knot: symmetric tridiagonal system of model.md 5.2.
std::vector<double> solveSimmCurvatures(const std::vector<double>& x,
                                        const std::vector<double>& h,
                                        const std::vector<double>& d) {
  const std::size_t n = x.size();
  if (n == 2) {
    return {0, 0};
  }
  const double start = n > 3 ? calcThirdDifference(x, d, 0) : 0;
  const double end = n > 3 ? calcThirdDifference(x, d, n - 4) : 0;
  std::vector<double> diagonal(n);
  std::vector<double> right(n);
  diagonal[0] = -h[0];
  right[0] = h[0] * h[0] * start;
  diagonal[n - 1] = -h[n - 2];
  right[n - 1] = -h[n - 2] * h[n - 2] * end;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    diagonal[i] = 2 * (h[i - 1] + h[i]);
    right[i] = d[i] - d[i - 1];
  }
  // Elimination without pivoting; the off-diagonal between i-1 and i is h[i-1].
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = h[i - 1] / diagonal[i - 1];
    diagonal[i] -= factor * h[i - 1];
    right[i] -= factor * right[i - 1];
  }
  std::vector<double> g(n);
  g[n - 1] = right[n - 1] / diagonal[n - 1];
  for (std::size_t i = n - 1; i-- > 0;) {
    g[i] = (right[i] - h[i] * g[i + 1]) / diagonal[i];
  }
  return g;
}

}  // namespace

ScalarFunction::ScalarFunction(const FunctionSpec& spec)
    : kind_(spec.kind), scale_(spec.scale), x_(spec.x), y_(spec.y) {
  require(std::isfinite(scale_), ErrorCode::kModelValue, "the scale of a function is not finite");
  if (kind_ != FunctionSpec::Kind::kSimmSpline && kind_ != FunctionSpec::Kind::kPiecewiseLinear) {
    require(!y_.empty(), ErrorCode::kModelValue, "a function has no coefficients");
    require(kind_ != FunctionSpec::Kind::kLinear || y_.size() == 2,
            ErrorCode::kModelValue,
            "a linear function of one coordinate needs 2 coefficients, found " +
                std::to_string(y_.size()));
    return;
  }
  requireKnots(spec);
  const std::size_t n = x_.size();
  std::vector<double> h(n - 1);
  std::vector<double> d(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    h[i] = x_[i + 1] - x_[i];
    d[i] = (y_[i + 1] - y_[i]) / h[i];
  }
  b_ = d;
  c_.assign(n - 1, 0.0);
  e_.assign(n - 1, 0.0);
  b_.push_back(d[n - 2]);
  if (kind_ == FunctionSpec::Kind::kSimmSpline) {
    const std::vector<double> g = solveSimmCurvatures(x_, h, d);
    for (std::size_t i = 0; i + 1 < n; ++i) {
      b_[i] = d[i] - h[i] * (g[i + 1] + 2 * g[i]);
      c_[i] = 3 * g[i];
      e_[i] = (g[i + 1] - g[i]) / h[i];
    }
    b_[n - 1] = d[n - 2] + h[n - 2] * (g[n - 2] + 2 * g[n - 1]);
  }
}

ScalarFunction::Sample ScalarFunction::evaluatePolynomial(double x) const {
  Sample s;
  for (const double coefficient : y_) {
    s.second = s.second * x + 2 * s.first;
    s.first = s.first * x + s.value;
    s.value = s.value * x + coefficient;
  }
  return s;
}

ScalarFunction::Sample ScalarFunction::evaluatePiecewise(double x) const {
  if (x < x_.front()) {
    return {y_.front() + b_.front() * (x - x_.front()), b_.front(), 0};
  }
  if (x > x_.back()) {
    return {y_.back() + b_.back() * (x - x_.back()), b_.back(), 0};
  }
  const auto after = std::upper_bound(x_.begin(), x_.end() - 1, x);
  const auto k = static_cast<std::size_t>(std::distance(x_.begin(), after)) - 1;
  const std::size_t i = std::min(k, x_.size() - 2);
  const double t = x - x_[i];
  return {y_[i] + t * (b_[i] + t * (c_[i] + t * e_[i])),
          b_[i] + t * (2 * c_[i] + 3 * t * e_[i]),
          2 * c_[i] + 6 * t * e_[i]};
}

ScalarFunction::Sample ScalarFunction::evaluate(double x) const {
  Sample s;
  switch (kind_) {
    case FunctionSpec::Kind::kConstant:
      s.value = y_[0];
      break;
    case FunctionSpec::Kind::kLinear:
      s = {y_[0] * x + y_[1], y_[0], 0};
      break;
    case FunctionSpec::Kind::kPolynomial:
      s = evaluatePolynomial(x);
      break;
    case FunctionSpec::Kind::kSimmSpline:
    case FunctionSpec::Kind::kPiecewiseLinear:
      s = evaluatePiecewise(x);
      break;
  }
  return {scale_ * s.value, scale_ * s.first, scale_ * s.second};
}

}  // namespace gaitmill

#include "core/muscle/schutte_curves.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace gaitmill {
namespace {

// Force-velocity (C. Raasch, L. Schutte): k of Hill's hyperbola, the ratio of slopes at rest, and
// the largest force while lengthening.
constexpr double kHill = 0.15;
constexpr double kSlopeRatio = 0.13;
constexpr double kMaxForce = 1.4;
constexpr double kEccentric = kSlopeRatio * kHill / (kHill + 1);

FunctionSpec makeSpline(std::vector<double> x, std::vector<double> y) {
  return {FunctionSpec::Kind::kSimmSpline, std::move(x), std::move(y), 1.0};
}

// Default curves of the class: spline knots, as distributed.
FunctionSpec makeDefaultActive() {
  return makeSpline({-5.307692, -4.307692, -1.923077, -0.884615, -0.269231, 0.230769, 0.461538,
                     0.52725,   0.62875,   0.71875,   0.86125,   1.045,     1.2175,   1.43875,
                     1.5,       1.615385,  2.0,       2.961538,  3.692308,  5.461538, 9.901902},
                    {0.012188, 0.021899, 0.036466, 0.052493, 0.075312, 0.114158, 0.157859,
                     0.226667, 0.636667, 0.856667, 0.95,     0.993333, 0.77,     0.246667,
                     0.193821, 0.133252, 0.072683, 0.044417, 0.036341, 0.021899, 0.007332});
}

FunctionSpec makeDefaultTendon() {
  return makeSpline({-10,
                     -0.002,
                     -0.001,
                     0,
                     0.00131,
                     0.00281,
                     0.00431,
                     0.00581,
                     0.00731,
                     0.00881,
                     0.0103,
                     0.0118,
                     0.0123,
                     9.2,
                     9.201,
                     9.202,
                     20},
                    {0,
                     0,
                     0,
                     0,
                     0.0108,
                     0.0257,
                     0.0435,
                     0.0652,
                     0.0915,
                     0.123,
                     0.161,
                     0.208,
                     0.227,
                     345,
                     345,
                     345,
                     345});
}

std::optional<ScalarFunction> makeStated(const std::optional<FunctionSpec>& spec) {
  return spec ? std::optional<ScalarFunction>(*spec) : std::nullopt;
}

double findLast(const FunctionSpec& curve) {
  return curve.x.empty() ? 1.0 : curve.x.back();
}

}  // namespace

SchutteCurves::SchutteCurves(const SchutteCurvesSpec& spec)
    : active_(spec.active_force_length.value_or(makeDefaultActive())),
      passive_(makeStated(spec.passive_force_length)),
      tendon_(spec.tendon_force_strain.value_or(makeDefaultTendon())),
      tendon_line_start_(1 + findLast(spec.tendon_force_strain.value_or(makeDefaultTendon()))) {}

CurvePoint SchutteCurves::calcActive(double norm_length) const noexcept {
  const ScalarFunction::Sample at = active_.evaluate(norm_length);
  return at.value < 0 ? CurvePoint{0, 0} : CurvePoint{at.value, at.first};
}

CurvePoint SchutteCurves::calcPassive(double norm_length) const noexcept {
  if (passive_) {
    const ScalarFunction::Sample at = passive_->evaluate(norm_length);
    return {at.value, at.first};
  }
  constexpr double kRate = 8;
  constexpr double kLengthAtOne = 1.5;
  const double value = std::exp(kRate * (norm_length - kLengthAtOne));
  return {value, kRate * value};
}

CurvePoint SchutteCurves::calcTendon(double norm_tendon_length) const noexcept {
  const double strain = norm_tendon_length - 1;
  if (strain < 0) {
    return {0, 0};
  }
  const ScalarFunction::Sample at = tendon_.evaluate(strain);
  return {at.value, at.first};
}

CurvePoint SchutteCurves::calcForceVelocity(double norm_velocity, double) const noexcept {
  const double v = norm_velocity;
  if (v <= -1) {
    return {0, 0};
  }
  if (v <= 0) {
    const double d = kHill - v;
    return {kHill * (1 + v) / d, kHill * (kHill + 1) / (d * d)};
  }
  const double d = v + kEccentric;
  return {(kMaxForce * v + kEccentric) / d, kEccentric * (kMaxForce - 1) / (d * d)};
}

double SchutteCurves::guessVelocity(double force, double) const noexcept {
  if (force <= 1) {
    return std::max(-1.0, kHill * (force - 1) / (kHill + std::max(force, 0.0)));
  }
  return force < kMaxForce ? std::min(1.0, kEccentric * (force - 1) / (kMaxForce - force)) : 1.0;
}

}  // namespace gaitmill

#include "core/muscle/thelen_curves.h"

#include <cmath>

#include "core/base/error.h"

namespace gaitmill {
namespace {

// Shape and end of the tendon's toe: the same in every tendon (Thelen 2003).
constexpr double kToeShape = 3;
constexpr double kToeForce = 0.33;

// Velocities scale with kBaseSpeed + kSpeedGain a.
constexpr double kBaseSpeed = 0.25;
constexpr double kSpeedGain = 0.75;

void requireParameter(bool ok, const char* message) {
  require(ok, ErrorCode::kMuscleParameter, message);
}

double speedScale(double activation) {
  return kBaseSpeed + kSpeedGain * activation;
}

}  // namespace

ThelenCurves::ThelenCurves(const ThelenCurvesSpec& spec)
    : active_shape_(spec.active_shape),
      passive_shape_(spec.passive_shape),
      passive_strain_(spec.passive_strain_at_one_force),
      passive_scale_(std::expm1(spec.passive_shape)),
      hill_shape_(1 / spec.velocity_shape),
      eccentric_rate_((2 + 2 / spec.velocity_shape) / (spec.max_eccentric_force - 1)),
      max_force_(spec.max_eccentric_force),
      line_force_(spec.linear_above_force * spec.max_eccentric_force) {
  requireParameter(spec.tendon_strain_at_one_force > 0, "FmaxTendonStrain is not positive");
  requireParameter(passive_strain_ > 0, "FmaxMuscleStrain is not positive");
  requireParameter(active_shape_ > 0, "KshapeActive is not positive");
  requireParameter(passive_shape_ > 0, "KshapePassive is not positive");
  requireParameter(spec.velocity_shape > 0, "Af is not positive");
  requireParameter(max_force_ > 1, "Flen is not above 1");
  requireParameter(line_force_ > 1 && line_force_ < max_force_,
                   "fv_linear_extrap_threshold is not between 1/Flen and 1");
  const double e3 = std::exp(kToeShape);
  toe_strain_ = 99 * spec.tendon_strain_at_one_force * e3 / (166 * e3 - 67);
  tendon_stiffness_ = (1 - kToeForce) / (spec.tendon_strain_at_one_force - toe_strain_);
  const double b = eccentric_rate_ * (max_force_ - line_force_);
  line_velocity_ = (line_force_ - 1) / b;
  line_slope_ = b * b / (b + eccentric_rate_ * (line_force_ - 1));
}

CurvePoint ThelenCurves::calcActive(double norm_length) const noexcept {
  const double x = norm_length - 1;
  const double value = std::exp(-x * x / active_shape_);
  return {value, -2 * x / active_shape_ * value};
}

CurvePoint ThelenCurves::calcPassive(double norm_length) const noexcept {
  const double x = norm_length - 1;
  if (x <= 0) {
    return {0, 0};
  }
  const double rate = passive_shape_ / passive_strain_;
  const double value = std::expm1(rate * x) / passive_scale_;
  return {value, rate * (value + 1 / passive_scale_)};
}

CurvePoint ThelenCurves::calcTendon(double norm_tendon_length) const noexcept {
  const double x = norm_tendon_length - 1;
  if (x <= 0) {
    return {0, 0};
  }
  if (x > toe_strain_) {
    return {tendon_stiffness_ * (x - toe_strain_) + kToeForce, tendon_stiffness_};
  }
  const double scale = kToeForce / std::expm1(kToeShape);
  const double rate = kToeShape / toe_strain_;
  const double value = scale * std::expm1(rate * x);
  return {value, rate * (value + scale)};
}

// Solved for the force, piece by piece: Hill's hyperbola while shortening and its tangent beyond
// no load; another hyperbola while lengthening and its tangent close to the largest force.
CurvePoint ThelenCurves::calcForceVelocity(double norm_velocity, double activation) const noexcept {
  const double scale = speedScale(activation);
  const double w = norm_velocity / scale;
  CurvePoint at;
  if (w <= -1) {
    at.slope = 1 / (1 + hill_shape_);
    at.value = (w + 1) * at.slope;
  } else if (w <= 0) {
    const double d = 1 - w * hill_shape_;
    at = {(1 + w) / d, (1 + hill_shape_) / (d * d)};
  } else if (w < line_velocity_) {
    const double d = 1 + eccentric_rate_ * w;
    at = {(1 + eccentric_rate_ * max_force_ * w) / d, eccentric_rate_ * (max_force_ - 1) / (d * d)};
  } else {
    at = {line_force_ + (w - line_velocity_) * line_slope_, line_slope_};
  }
  return {at.value, at.slope / scale};
}

double ThelenCurves::guessVelocity(double force, double activation) const noexcept {
  double w = 0;
  if (force <= 0) {
    w = (1 + hill_shape_) * force - 1;
  } else if (force <= 1) {
    w = (force - 1) / (1 + force * hill_shape_);
  } else if (force < line_force_) {
    w = (force - 1) / (eccentric_rate_ * (max_force_ - force));
  } else {
    w = line_velocity_ + (force - line_force_) / line_slope_;
  }
  return w * speedScale(activation);
}

}  // namespace gaitmill

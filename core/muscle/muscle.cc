#include "core/muscle/muscle.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/base/where.h"

namespace gaitmill {
namespace {

// "Numerically zero" of the muscle equations: 2^(-52 * 7/8) (spec/muscle.md 1).
constexpr double kNegligible = 2.0097183471152322e-14;
// Below this damping a muscle counts as undamped, which this product does not offer.
constexpr double kMinDamping = 0.001;
// Without damping the balance loses its root at activation 0 (spec/muscle.md 10).
constexpr double kMinThelenActivation = 0.01;
// Root finding stops at a step of this size relative to the normalised velocity or length; or at a
// Newton step of the other, which leaves an error of its square.
constexpr double kRoundOff = 4e-16;
constexpr double kLastNewtonStep = 3e-9;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMaxSteps = 200;

void requireField(bool ok, const MuscleSpec& spec, const char* field, double value) {
  Where where = atMuscle(spec.name);
  where.field = field;
  require(
      ok,
      ErrorCode::kMuscleParameter,
      "muscle '" + spec.name + "': " + field + " is " + std::to_string(value) + ", out of range",
      where);
}

void validate(const MuscleSpec& s) {
  requireField(s.max_isometric_force > 0, s, "max_isometric_force", s.max_isometric_force);
  requireField(s.optimal_fiber_length > 0, s, "optimal_fiber_length", s.optimal_fiber_length);
  requireField(s.tendon_slack_length > 0, s, "tendon_slack_length", s.tendon_slack_length);
  requireField(s.pennation_at_optimal >= 0 && s.pennation_at_optimal < kPi / 2,
               s,
               "pennation_angle_at_optimal",
               s.pennation_at_optimal);
  requireField(
      s.max_contraction_velocity > 0, s, "max_contraction_velocity", s.max_contraction_velocity);
  const bool needs_damping = s.tendon != TendonKind::kRigid && s.kind != MuscleKind::kThelen2003;
  requireField(
      s.fiber_damping >= (needs_damping ? kMinDamping : 0.0), s, "fiber_damping", s.fiber_damping);
  requireField(s.kind != MuscleKind::kThelen2003 || s.tendon == TendonKind::kElastic,
               s,
               "ignore_tendon_compliance",
               1);
  requireField(s.kind != MuscleKind::kThelen2003 || s.minimum_activation >= kMinThelenActivation,
               s,
               "minimum_activation",
               s.minimum_activation);
  requireField(
      s.activation_time_constant > 0, s, "activation_time_constant", s.activation_time_constant);
  requireField(s.deactivation_time_constant > 0,
               s,
               "deactivation_time_constant",
               s.deactivation_time_constant);
  requireField(s.minimum_activation >= 0 && s.minimum_activation <= 1,
               s,
               "minimum_activation",
               s.minimum_activation);
  requireField(s.maximum_pennation >= s.pennation_at_optimal && s.maximum_pennation < kPi / 2,
               s,
               "maximum_pennation_angle",
               s.maximum_pennation);
}

// Root of an increasing function by Newton steps inside a bracket that grows until it holds the
// root; bisection where Newton does not halve the residual. `scale` is the size of a sensible step.
template <class Function>
double solveIncreasing(const Function& residual, double x, double scale) {
  double low = -kInfinity;
  double high = kInfinity;
  double last_size = kInfinity;
  for (int step = 0; step < kMaxSteps; ++step) {
    const auto at = residual(x);
    if (at.value == 0) {
      return x;
    }
    (at.value > 0 ? high : low) = x;
    const double size = std::abs(at.value);
    const bool slow = size > 0.5 * last_size;
    last_size = size;
    double next = x - at.value / at.slope;
    bool newton = false;
    if (!(next > low && next < high) || !(at.slope > 0)) {
      const bool bracketed = low > -kInfinity && high < kInfinity;
      next = bracketed ? 0.5 * (low + high) : (at.value > 0 ? x - scale : x + scale);
      scale *= 2;
    } else if (slow && low > -kInfinity && high < kInfinity) {
      next = 0.5 * (low + high);
    } else {
      newton = true;
    }
    const double change = std::abs(next - x);
    x = next;
    if (change <= (newton ? kLastNewtonStep : kRoundOff) * (1 + std::abs(x))) {
      break;
    }
  }
  return x;
}

}  // namespace

Muscle::Muscle(const MuscleSpec& spec, std::shared_ptr<const MuscleCurves> curves)
    : kind_(spec.kind), curves_(std::move(curves)) {
  validate(spec);
  makeOwnCurves(spec);
  activation_dynamics_.activation_time_constant = spec.activation_time_constant;
  activation_dynamics_.deactivation_time_constant = spec.deactivation_time_constant;
  max_force_ = spec.max_isometric_force;
  optimal_length_ = spec.optimal_fiber_length;
  slack_length_ = spec.tendon_slack_length;
  max_speed_ = spec.optimal_fiber_length * spec.max_contraction_velocity;
  damping_ = kind_ == MuscleKind::kThelen2003 ? 0 : spec.fiber_damping;
  minimum_activation_ = spec.minimum_activation;
  rigid_ = spec.tendon == TendonKind::kRigid;

  height_ = optimal_length_ * std::sin(spec.pennation_at_optimal);
  max_pennation_sin_ = std::sin(spec.maximum_pennation);
  max_pennation_cos_ = std::cos(spec.maximum_pennation);
  min_pennation_length_ =
      spec.maximum_pennation > kNegligible ? height_ / max_pennation_sin_ : 0.01 * optimal_length_;
  const double active_start =
      kind_ == MuscleKind::kMillard2012 ? curves_->active_force_length.startX() : 0;
  min_length_ = std::max({kNegligible, active_start * optimal_length_, min_pennation_length_});
}

void Muscle::makeOwnCurves(const MuscleSpec& spec) {
  try {
    switch (kind_) {
      case MuscleKind::kMillard2012:
        check(curves_ != nullptr, "a Millard muscle comes with its curves");
        break;
      case MuscleKind::kThelen2003:
        thelen_ = std::make_shared<const ThelenCurves>(spec.thelen);
        break;
      case MuscleKind::kSchutte1993:
        schutte_ = std::make_shared<const SchutteCurves>(spec.schutte);
        activation_dynamics_.law = ActivationDynamics::Law::kSchutte1993;
        activation_dynamics_.excitation_rate = spec.schutte.excitation_rate;
        activation_dynamics_.activation_rate = spec.schutte.activation_rate;
        break;
    }
  } catch (Error& error) {
    error.completeWhere(atMuscle(spec.name));
    throw;
  }
}

template <class Function>
auto Muscle::withCurves(const Function& function) const noexcept {
  if (kind_ == MuscleKind::kMillard2012) {
    return function(*curves_);
  }
  return kind_ == MuscleKind::kThelen2003 ? function(*thelen_) : function(*schutte_);
}

CurvePoint Muscle::calcActiveForceLength(double norm_length) const noexcept {
  return withCurves([&](const auto& curves) { return curves.calcActive(norm_length); });
}

CurvePoint Muscle::calcPassiveForceLength(double norm_length) const noexcept {
  return withCurves([&](const auto& curves) { return curves.calcPassive(norm_length); });
}

CurvePoint Muscle::calcForceVelocity(double norm_velocity) const noexcept {
  return withCurves([&](const auto& curves) { return curves.calcForceVelocity(norm_velocity, 1); });
}

double Muscle::tendonLineStart() const noexcept {
  return withCurves([](const auto& curves) { return curves.tendonLineStart(); });
}

double Muscle::calcForceVelocityAt(double norm_velocity, double activation) const noexcept {
  return withCurves([&](const auto& curves) {
    return curves.calcForceVelocity(norm_velocity, activation).value;
  });
}

CurvePoint Muscle::calcTendonForceLength(double norm_tendon_length) const noexcept {
  return withCurves([&](const auto& curves) { return curves.calcTendon(norm_tendon_length); });
}

Muscle::Geometry Muscle::calcGeometry(double fiber_length) const noexcept {
  Geometry g;
  const double l = fiber_length;
  if (height_ == 0) {
    g.along = l;
    return g;
  }
  const double sin = height_ / l;
  if (l > min_pennation_length_ && sin < max_pennation_sin_) {
    g.cos = std::sqrt((1 - sin) * (1 + sin));
    g.cos_slope = sin * sin / (l * g.cos);
    g.along_slope = 1 / g.cos;
  } else {
    g.cos = max_pennation_cos_;
    g.along_slope = g.cos;
  }
  g.along = l * g.cos;
  return g;
}

double Muscle::calcRigidLength(double path_length) const noexcept {
  const double along = path_length - slack_length_;
  return along >= min_pennation_length_ * max_pennation_cos_ ? std::hypot(height_, along)
                                                             : min_pennation_length_;
}

FiberState Muscle::calcRigid(double activation,
                             double path_length,
                             double path_speed) const noexcept {
  FiberState state;
  state.length = std::max(min_length_, calcRigidLength(path_length));
  const Geometry geometry = calcGeometry(state.length);
  state.cos_pennation = geometry.cos;
  state.tendon_length = path_length - geometry.along;
  const double norm_length = state.length / optimal_length_;
  state.active_length_multiplier = calcActiveForceLength(norm_length).value;
  state.passive_multiplier = calcPassiveForceLength(norm_length).value;

  const bool slack = state.tendon_length < slack_length_ - kNegligible;
  state.velocity = slack ? 0 : path_speed * geometry.cos;
  if (state.length <= min_length_ && state.velocity <= 0) {
    state.velocity = 0;
    return state;
  }
  state.norm_velocity = state.velocity / max_speed_;
  const double a = std::clamp(activation, minimum_activation_, 1.0);
  state.velocity_multiplier = calcForceVelocityAt(state.norm_velocity, a);
  state.active_force = max_force_ * a * state.active_length_multiplier * state.velocity_multiplier;
  // Fast shortening makes the damper push; a fiber cannot, so the damping force is cut.
  state.passive_force =
      std::max(max_force_ * (state.passive_multiplier + damping_ * state.norm_velocity),
               -state.active_force);
  state.tendon_force = (state.active_force + state.passive_force) * geometry.cos;
  return state;
}

FiberState Muscle::calcElastic(double activation,
                               double fiber_length,
                               double path_length) const noexcept {
  FiberState state;
  const double a = std::clamp(activation, minimum_activation_, 1.0);
  state.length = std::max(min_length_, fiber_length);
  const Geometry geometry = calcGeometry(state.length);
  state.cos_pennation = geometry.cos;
  state.tendon_length = path_length - geometry.along;
  const double norm_length = state.length / optimal_length_;
  state.active_length_multiplier = calcActiveForceLength(norm_length).value;
  state.passive_multiplier = calcPassiveForceLength(norm_length).value;
  const double tendon = calcTendonForceLength(state.tendon_length / slack_length_).value;
  state.tendon_force = max_force_ * tendon;

  // Start from the inverse force-velocity curve, which is exact without damping.
  const double force = (tendon / geometry.cos - state.passive_multiplier) /
                       std::max(a * state.active_length_multiplier, 1e-4);
  const double guess =
      withCurves([&](const auto& curves) { return curves.guessVelocity(force, a); }) * max_speed_;
  state.velocity = solveStageVelocity({a, state.length, path_length, 0.0}, guess);
  if (state.length <= min_length_ && state.velocity <= 0) {
    state.velocity = 0;
    return state;
  }
  state.norm_velocity = state.velocity / max_speed_;
  state.velocity_multiplier = calcForceVelocityAt(state.norm_velocity, a);
  state.active_force = max_force_ * a * state.active_length_multiplier * state.velocity_multiplier;
  state.passive_force = max_force_ * (state.passive_multiplier + damping_ * state.norm_velocity);
  return state;
}

double Muscle::calcTendonForce(double fiber_length, double path_length) const noexcept {
  const double along = calcGeometry(std::max(min_length_, fiber_length)).along;
  return max_force_ * calcTendonForceLength((path_length - along) / slack_length_).value;
}

template <class Curves>
Muscle::Residual Muscle::calcStageResidual(const Curves& curves,
                                           const Stage& stage,
                                           double norm_velocity) const noexcept {
  // How far the fiber moves per unit of normalised velocity; none once it rests on its stop.
  double reach = stage.step * max_speed_;
  double length = stage.start_length + reach * norm_velocity;
  if (length < min_length_) {
    length = min_length_;
    reach = 0;
  }
  const Geometry g = calcGeometry(length);
  const double a = stage.activation;
  const CurvePoint active = curves.calcActive(length / optimal_length_);
  const CurvePoint passive = curves.calcPassive(length / optimal_length_);
  const CurvePoint velocity = curves.calcForceVelocity(norm_velocity, a);
  const CurvePoint tendon = curves.calcTendon((stage.path_length - g.along) / slack_length_);

  const double fiber = a * active.value * velocity.value + passive.value + damping_ * norm_velocity;
  const double fiber_slope_v = a * active.value * velocity.slope + damping_;
  const double fiber_slope_l =
      (a * active.slope * velocity.value + passive.slope) / optimal_length_;
  return {fiber * g.cos - tendon.value,
          fiber_slope_v * g.cos + reach * (fiber_slope_l * g.cos + fiber * g.cos_slope +
                                           tendon.slope * g.along_slope / slack_length_)};
}

double Muscle::solveStageVelocity(const Stage& given, double guess) const noexcept {
  Stage stage = given;
  if (kind_ == MuscleKind::kThelen2003) {
    stage.activation = std::max(stage.activation, minimum_activation_);
  }
  const double norm_velocity = withCurves([&](const auto& curves) {
    return solveIncreasing(
        [&](double v) { return calcStageResidual(curves, stage, v); }, guess / max_speed_, 0.1);
  });
  const double velocity = norm_velocity * max_speed_;
  const bool stops = stage.step > 0 && stage.start_length + stage.step * velocity < min_length_;
  return stops ? (min_length_ - stage.start_length) / stage.step : velocity;
}

template <class Curves>
Muscle::Residual Muscle::calcStaticResidual(const Curves& curves,
                                            double activation,
                                            double fiber_length,
                                            double path_length) const noexcept {
  const Geometry g = calcGeometry(fiber_length);
  const CurvePoint active = curves.calcActive(fiber_length / optimal_length_);
  const CurvePoint passive = curves.calcPassive(fiber_length / optimal_length_);
  const CurvePoint tendon = curves.calcTendon((path_length - g.along) / slack_length_);
  const double fiber = activation * active.value + passive.value;
  const double fiber_slope = (activation * active.slope + passive.slope) / optimal_length_;
  return {fiber * g.cos - tendon.value,
          fiber_slope * g.cos + fiber * g.cos_slope + tendon.slope * g.along_slope / slack_length_};
}

template <class Curves>
double Muscle::findStaticLength(const Curves& curves,
                                double activation,
                                double path_length) const noexcept {
  const double a = std::clamp(activation, minimum_activation_, 1.0);
  double low = min_length_;
  if (calcStaticResidual(curves, a, low, path_length).value >= 0) {
    return low;
  }
  // At this length the tendon has length zero and pulls nothing.
  double high = std::max(low, std::hypot(path_length, height_));
  double last_size = kInfinity;
  double length =
      std::clamp(std::hypot(height_, std::max(0.0, path_length - 1.01 * slack_length_)), low, high);
  for (int step = 0; step < kMaxSteps; ++step) {
    const Residual at = calcStaticResidual(curves, a, length, path_length);
    (at.value > 0 ? high : low) = length;
    const bool slow = std::abs(at.value) > 0.5 * last_size;
    last_size = std::abs(at.value);
    double next = length - at.value / at.slope;
    if (slow || !(next > low && next < high)) {
      next = 0.5 * (low + high);
    }
    const double change = std::abs(next - length);
    length = next;
    if (change <= kRoundOff * optimal_length_) {
      break;
    }
  }
  return length;
}

double Muscle::solveStaticLength(double activation, double path_length) const noexcept {
  return withCurves(
      [&](const auto& curves) { return findStaticLength(curves, activation, path_length); });
}

Muscle::ForceLine Muscle::calcRigidForceLine(double path_length, double path_speed) const noexcept {
  const double length = calcRigidLength(path_length);
  if (length <= min_length_) {
    return {};
  }
  const double cos = calcGeometry(length).cos;
  const double norm_velocity = path_speed * cos / max_speed_;
  const double along = max_force_ * cos;
  double velocity_multiplier = calcForceVelocity(norm_velocity).value;
  if (kind_ == MuscleKind::kThelen2003) {
    velocity_multiplier = std::max(0.0, velocity_multiplier);
  }
  return {
      along * calcActiveForceLength(length / optimal_length_).value * velocity_multiplier,
      along * (calcPassiveForceLength(length / optimal_length_).value + damping_ * norm_velocity)};
}

namespace {

/// The curves of one muscle; their faults carry its name.
std::shared_ptr<const MuscleCurves> makeCurves(const MuscleSpec& spec) {
  try {
    return std::make_shared<const MuscleCurves>(spec.curves);
  } catch (Error& error) {
    error.completeWhere(atMuscle(spec.name));
    throw;
  }
}

}  // namespace

std::vector<Muscle> makeMuscles(const std::vector<MuscleSpec>& specs) {
  struct Built {
    const MuscleCurvesSpec* spec;
    std::shared_ptr<const MuscleCurves> curves;
  };
  std::vector<Built> built;
  std::vector<Muscle> muscles;
  muscles.reserve(specs.size());
  for (const MuscleSpec& spec : specs) {
    if (spec.kind != MuscleKind::kMillard2012) {
      muscles.emplace_back(spec, nullptr);
      continue;
    }
    auto same = std::find_if(built.begin(), built.end(), [&](const Built& b) {
      return haveSameCurves(*b.spec, spec.curves);
    });
    if (same == built.end()) {
      built.push_back({&spec.curves, makeCurves(spec)});
      same = std::prev(built.end());
    }
    muscles.emplace_back(spec, same->curves);
  }
  return muscles;
}

}  // namespace gaitmill

#include "core/muscle/muscle_curves.h"

#include <algorithm>
#include <tuple>

#include "core/base/error.h"

namespace gaitmill {
namespace {

using Joint = QuinticCurve::Joint;

void requireParameter(bool ok, const char* message) {
  require(ok, ErrorCode::kMuscleParameter, message);
}

// Curviness 0..1 of a document to the tightness of a corner (spec/muscle.md 3.1).
double tightnessOf(double curviness) {
  requireParameter(curviness >= 0 && curviness <= 1,
                   "curviness of a muscle curve is not in [0, 1]");
  return 0.1 + 0.8 * curviness;
}

// Half of the slopes near the ends: the inverse curve must stay finite there.
EndSlopes inverseEndSlopes(const MuscleCurvesSpec& spec) {
  return {0.5 * spec.concentric_slope_near_vmax, 0.5 * spec.eccentric_slope_near_vmax};
}

auto tieCurves(const MuscleCurvesSpec& s) {
  return std::tie(s.active_min_length,
                  s.active_transition_length,
                  s.active_max_length,
                  s.active_shallow_slope,
                  s.active_minimum_value,
                  s.concentric_slope_at_vmax,
                  s.concentric_slope_near_vmax,
                  s.isometric_slope,
                  s.eccentric_slope_at_vmax,
                  s.eccentric_slope_near_vmax,
                  s.max_eccentric_force,
                  s.concentric_curviness,
                  s.eccentric_curviness,
                  s.passive_strain_at_zero_force,
                  s.passive_strain_at_one_force,
                  s.passive_stiffness_at_low_force,
                  s.passive_stiffness_at_one_force,
                  s.passive_curviness,
                  s.tendon_strain_at_one_force,
                  s.tendon_stiffness_at_one_force,
                  s.tendon_force_at_toe_end,
                  s.tendon_curviness);
}

auto tieCurves(const ThelenCurvesSpec& s) {
  return std::tie(s.tendon_strain_at_one_force,
                  s.passive_strain_at_one_force,
                  s.active_shape,
                  s.passive_shape,
                  s.velocity_shape,
                  s.max_eccentric_force,
                  s.linear_above_force);
}

bool statesCurves(const SchutteCurvesSpec& s) {
  return s.active_force_length || s.passive_force_length || s.tendon_force_strain;
}

}  // namespace

QuinticCurve makeActiveForceLength(const MuscleCurvesSpec& spec, double minimum_value) {
  const double x0 = spec.active_min_length;
  const double x1 = spec.active_transition_length;
  const double x2 = 1.0;
  const double x3 = spec.active_max_length;
  const double s = spec.active_shallow_slope;
  requireParameter(0 <= x0 && x0 < x1 && x1 < x2 && x2 < x3,
                   "active force-length curve: lengths are not 0 <= min < transition < 1 < max");
  requireParameter(0 <= s && s < (1 - minimum_value) / (x2 - x1),
                   "active force-length curve: shallow ascending slope is out of range");
  const double d = 0.05 * x2;
  const double xs = x2 - d;
  const double y1 = 1 - s * (xs - x1);
  const double c = tightnessOf(1.0);
  return QuinticCurve({{x0, minimum_value, 0},
                       {x0 + 0.5 * (x1 - x0), 0.5 * y1, 1.25 * y1 / (x1 - x0)},
                       {x1 + 0.5 * (xs - x1), y1 + 0.5 * (1 - y1), s},
                       {x2, 1, 0},
                       {(x2 + d) + 0.5 * (x3 - (x2 + d)), 0.5, -1 / ((x3 - d) - (x2 + d))},
                       {x3, minimum_value, 0}},
                      {c, c, c, c, c});
}

QuinticCurve makeForceVelocity(const MuscleCurvesSpec& spec, const EndSlopes& ends) {
  const double near_c = spec.concentric_slope_near_vmax;
  const double near_e = spec.eccentric_slope_near_vmax;
  const double f_max = spec.max_eccentric_force;
  requireParameter(f_max > 1 && spec.isometric_slope > 1,
                   "force-velocity curve: eccentric force and isometric slope must exceed 1");
  requireParameter(0 <= ends.concentric && ends.concentric < near_c && near_c <= 1,
                   "force-velocity curve: concentric slopes are out of range");
  requireParameter(0 <= ends.eccentric && ends.eccentric <= near_e && near_e < f_max - 1,
                   "force-velocity curve: eccentric slopes are out of range");
  const double cc = tightnessOf(spec.concentric_curviness);
  const double ce = tightnessOf(spec.eccentric_curviness);
  return QuinticCurve({{-1, 0, ends.concentric},
                       {-0.9, 0.05 * (near_c + ends.concentric), near_c},
                       {0, 1, spec.isometric_slope},
                       {0.9, f_max - 0.05 * (near_e + ends.eccentric), near_e},
                       {1, f_max, ends.eccentric}},
                      {cc, cc, ce, ce});
}

QuinticCurve makePassiveForceLength(const MuscleCurvesSpec& spec) {
  const double e0 = spec.passive_strain_at_zero_force;
  const double e1 = spec.passive_strain_at_one_force;
  const double k_low = spec.passive_stiffness_at_low_force;
  const double k_iso = spec.passive_stiffness_at_one_force;
  requireParameter(e1 > e0, "passive curve: strain at one force must exceed strain at zero force");
  requireParameter(k_iso > 1 / (e1 - e0) && 0 < k_low && k_low < 1 / (e1 - e0),
                   "passive curve: stiffnesses are out of range");
  const double x0 = 1 + e0;
  const double x_iso = 1 + e1;
  const double d = std::min(0.1 / k_iso, 0.1 * (x_iso - x0));
  const double c = tightnessOf(spec.passive_curviness);
  return QuinticCurve({{x0, 0, 0}, {x0 + d, k_low * d / 2, k_low}, {x_iso, 1, k_iso}}, {c, c});
}

QuinticCurve makeTendonForceLength(const MuscleCurvesSpec& spec) {
  const double e = spec.tendon_strain_at_one_force;
  const double k_iso = spec.tendon_stiffness_at_one_force;
  const double f_toe = spec.tendon_force_at_toe_end;
  requireParameter(e > 0 && 0 < f_toe && f_toe < 1 && k_iso > 1 / e,
                   "tendon curve: strain, stiffness or toe force is out of range");
  const double x_toe = (1 + e) + (f_toe - 1) / k_iso;
  const double x_foot = 1 + (x_toe - 1) / 10;
  const double y_mid = f_toe / 2;
  const double x_mid = (1 + e) + (y_mid - 1) / k_iso;
  const double s_mid = y_mid / (x_mid - x_foot);
  const double x_corner = x_foot + 0.5 * (x_mid - x_foot);
  const double c = tightnessOf(spec.tendon_curviness);
  return QuinticCurve(
      {{1, 0, 0}, {x_corner, s_mid * (x_corner - x_foot), s_mid}, {x_toe, f_toe, k_iso}}, {c, c});
}

MuscleCurves::MuscleCurves(const MuscleCurvesSpec& spec)
    : active_force_length(makeActiveForceLength(spec, 0.0)),
      force_velocity(makeForceVelocity(spec, EndSlopes{})),
      inverse_force_velocity(makeForceVelocity(spec, inverseEndSlopes(spec)).makeInverse()),
      passive_force_length(makePassiveForceLength(spec)),
      tendon_force_length(makeTendonForceLength(spec)) {}

bool haveSameCurves(const MuscleCurvesSpec& a, const MuscleCurvesSpec& b) {
  return tieCurves(a) == tieCurves(b);
}

bool haveSameCurves(const MuscleSpec& a, const MuscleSpec& b) {
  if (a.kind != b.kind) {
    return false;
  }
  switch (a.kind) {
    case MuscleKind::kMillard2012:
      break;
    case MuscleKind::kThelen2003:
      return tieCurves(a.thelen) == tieCurves(b.thelen);
    case MuscleKind::kSchutte1993:
      return !statesCurves(a.schutte) && !statesCurves(b.schutte);
  }
  return haveSameCurves(a.curves, b.curves);
}

}  // namespace gaitmill

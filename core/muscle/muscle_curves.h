#pragma once

#include <algorithm>

#include "core/data/model_spec.h"
#include "core/muscle/quintic_curve.h"

namespace gaitmill {

/// The normalised curves of a damped or rigid-tendon Millard muscle (spec/muscle.md 3.3 to 3.6).
/// The active curve ends at zero force and the force-velocity curve is flat beyond +-1, whatever
/// the document says about those three values (2.1): damping keeps the balance solvable.
struct MuscleCurves {
  /// @throws Error kMuscleParameter if a value is outside the range of its curve
  explicit MuscleCurves(const MuscleCurvesSpec& spec);

  QuinticCurve active_force_length;     ///< fAL(l/l0M)
  QuinticCurve force_velocity;          ///< fV(v/(l0M vmax))
  QuinticCurve inverse_force_velocity;  ///< v/(l0M vmax) of fV: a first guess only, its end slopes
                                        ///< are half the near ones
  QuinticCurve passive_force_length;    ///< fPE(l/l0M)
  QuinticCurve tendon_force_length;     ///< fT(lT/lsT)

  // The same under the names that the curves of all kinds of muscles have, see ThelenCurves.
  CurvePoint calcActive(double norm_length) const noexcept {
    return active_force_length.calc(norm_length);
  }
  CurvePoint calcPassive(double norm_length) const noexcept {
    return passive_force_length.calc(norm_length);
  }
  CurvePoint calcTendon(double norm_tendon_length) const noexcept {
    return tendon_force_length.calc(norm_tendon_length);
  }
  double tendonLineStart() const noexcept { return tendon_force_length.endX(); }
  CurvePoint calcForceVelocity(double norm_velocity, double /*activation*/) const noexcept {
    return force_velocity.calc(norm_velocity);
  }
  double guessVelocity(double force, double /*activation*/) const noexcept {
    return std::clamp(inverse_force_velocity.calc(force).value, -1.0, 1.0);
  }
};

/// @param minimum_value  force at both ends of the active range
QuinticCurve makeActiveForceLength(const MuscleCurvesSpec& spec, double minimum_value);

/// Slopes of a force-velocity curve at maximum shortening and lengthening speed.
struct EndSlopes {
  double concentric = 0;
  double eccentric = 0;
};
QuinticCurve makeForceVelocity(const MuscleCurvesSpec& spec, const EndSlopes& ends);
QuinticCurve makePassiveForceLength(const MuscleCurvesSpec& spec);
QuinticCurve makeTendonForceLength(const MuscleCurvesSpec& spec);

/// Whether two parameter sets give the same curves, so that they can be shared.
bool haveSameCurves(const MuscleCurvesSpec& a, const MuscleCurvesSpec& b);
/// The same of two muscles of any kind. Schutte's count as different where both state curves.
bool haveSameCurves(const MuscleSpec& a, const MuscleSpec& b);

}  // namespace gaitmill

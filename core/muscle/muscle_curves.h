#pragma once

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

}  // namespace gaitmill

#pragma once

#include "core/data/model_spec.h"
#include "core/muscle/quintic_curve.h"

namespace gaitmill {

/// Normalised curves of Thelen (2003), J Biomech Eng 125:70-77, in the form of spec/muscle.md 10.
/// The model states the force-velocity relation as the velocity of a force; here it is inverted in
/// closed form, so that the fiber's balance has the same form as that of other muscles. All curves
/// but the active one increase without bound, their slopes never vanish where the muscle pulls:
/// the balance always has exactly one root while activation is not zero. Immutable.
class ThelenCurves {
 public:
  /// @throws Error kMuscleParameter for a value outside the range of its curve
  explicit ThelenCurves(const ThelenCurvesSpec& spec);

  /// fAL(l/l0M) = exp(-(l/l0M - 1)^2/gamma)
  CurvePoint calcActive(double norm_length) const noexcept;
  /// fPE(l/l0M): exponential above 1, without a linear end
  CurvePoint calcPassive(double norm_length) const noexcept;
  /// fT(lT/lsT): exponential toe, then a line
  CurvePoint calcTendon(double norm_tendon_length) const noexcept;
  double tendonLineStart() const noexcept { return 1 + toe_strain_; }
  /// fV(v/(l0M vmax)) and its slope. Fibers are slower at low activation: the curve is one function
  /// of v/(l0M vmax (0.25 + 0.75 a)). Negative below the shortening speed of no load.
  CurvePoint calcForceVelocity(double norm_velocity, double activation) const noexcept;
  /// The inverse: v/(l0M vmax) of fV.
  double guessVelocity(double force, double activation) const noexcept;

 private:
  double active_shape_;
  double passive_shape_;  ///< kPE
  double passive_strain_;
  double passive_scale_;  ///< e^kPE - 1
  double toe_strain_;
  double tendon_stiffness_;  ///< of the line
  double hill_shape_;        ///< 1/Af
  double eccentric_rate_;    ///< c = (2 + 2/Af)/(Flen - 1)
  double max_force_;         ///< Flen
  double line_force_;        ///< force and velocity where the eccentric line begins, its slope
  double line_velocity_;
  double line_slope_;
};

}  // namespace gaitmill

#pragma once

#include <optional>

#include "core/data/model_spec.h"
#include "core/math/scalar_function.h"
#include "core/muscle/quintic_curve.h"

namespace gaitmill {

/// Normalised curves of the muscle of Schutte, Rodgers, Zajac & Glaser (1993), IEEE Trans Rehabil
/// Eng 1:109-125, with the constants and default curves with which SIMM and OpenSim distribute it
/// (class Schutte1993Muscle_Deprecated). Fiber force is a fAL fV + fPE + beta v/(l0M vmax), vmax
/// the inverse of the document's time scale. Immutable, evaluation does not allocate.
///
/// The class computes the same relation as a quadratic in the velocity and cuts the force that
/// depends on velocity at zero from below; here the balance holds there, too, so that a slack
/// tendon leaves the fiber to shorten under its damping alone.
class SchutteCurves {
 public:
  /// @throws Error kModelValue if a curve of the document does not define a function
  explicit SchutteCurves(const SchutteCurvesSpec& spec);

  /// fAL(l/l0M), never negative.
  CurvePoint calcActive(double norm_length) const noexcept;
  /// fPE(l/l0M): exp(8 (l/l0M - 1) - 4) unless the document states a curve.
  CurvePoint calcPassive(double norm_length) const noexcept;
  /// fT(lT/lsT), 0 without strain.
  CurvePoint calcTendon(double norm_tendon_length) const noexcept;
  /// 1 plus the last strain that the curve was given at.
  double tendonLineStart() const noexcept { return tendon_line_start_; }
  /// fV(v/(l0M vmax)): Hill's hyperbola while shortening, 0 beyond maximum speed, and another one
  /// towards 1.4 while lengthening; the same at every activation.
  CurvePoint calcForceVelocity(double norm_velocity, double activation) const noexcept;
  /// The inverse, limited to [-1, 1].
  double guessVelocity(double force, double activation) const noexcept;

 private:
  ScalarFunction active_;
  std::optional<ScalarFunction> passive_;
  ScalarFunction tendon_;  ///< of strain
  double tendon_line_start_;
};

}  // namespace gaitmill

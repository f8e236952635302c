#pragma once

#include <memory>
#include <vector>

#include "core/data/model_spec.h"
#include "core/muscle/activation_dynamics.h"
#include "core/muscle/muscle_curves.h"
#include "core/muscle/schutte_curves.h"
#include "core/muscle/thelen_curves.h"

namespace gaitmill {

/// Everything about one muscle-tendon unit at one instant. Lengthening is positive, forces pull.
struct FiberState {
  double length = 0;                    ///< l [m]
  double velocity = 0;                  ///< v = dl/dt [m/s]
  double norm_velocity = 0;             ///< v/(l0M vmax) [-]
  double cos_pennation = 1;             ///< cos(phi) [-]
  double tendon_length = 0;             ///< [m]
  double active_length_multiplier = 0;  ///< fAL [-]
  double velocity_multiplier = 1;       ///< fV [-]
  double passive_multiplier = 0;        ///< fPE [-]
  double active_force = 0;              ///< F0M a fAL fV, along the fiber [N]
  double passive_force = 0;             ///< F0M (fPE + beta v/(l0M vmax)), along the fiber [N]
  double tendon_force = 0;              ///< what pulls on the skeleton [N] >= 0
};

/// Hill-type muscle with fixed-height pennation (spec/muscle.md), after Millard et al. (2013),
/// J Biomech Eng 135:021005, with fiber damping; or after Thelen (2003) or Schutte et al. (1993),
/// which differ by their curves (ThelenCurves, SchutteCurves), their activation dynamics and their
/// shortest fiber. Massless: along the tendon, fiber and tendon force balance. Immutable, safe to
/// share between threads; no member allocates or fails once built.
///
/// Where the formulas below say fV, Thelen's also depends on activation. Its muscles have no
/// damping and need none: their fV has a slope everywhere, and activation is kept at its minimum or
/// above.
///
/// Units of the arguments: activation [-] in [minimum activation, 1]; path_length and fiber_length
/// [m]; path_speed [m/s]. Fiber lengths below minFiberLength() count as that length.
class Muscle {
 public:
  /// @param curves  those of `spec.curves`, shared with other muscles; unused and may be null
  /// unless
  ///   the muscle is Millard's
  /// @throws Error kMuscleParameter naming the muscle and the first field out of range
  Muscle(const MuscleSpec& spec, std::shared_ptr<const MuscleCurves> curves);

  bool hasRigidTendon() const { return rigid_; }
  double maxIsometricForce() const { return max_force_; }
  double optimalFiberLength() const { return optimal_length_; }
  double tendonSlackLength() const { return slack_length_; }
  double maxFiberSpeed() const { return max_speed_; }  ///< l0M vmax [m/s]
  double minimumActivation() const { return minimum_activation_; }
  /// Shortest fiber the model allows: steepest pennation, and in Millard's model the active range
  /// (spec/muscle.md 4, 10).
  double minFiberLength() const { return min_length_; }
  const ActivationDynamics& activationDynamics() const { return activation_dynamics_; }

  /// State of a muscle whose tendon is rigid: the fiber follows the path (spec/muscle.md 6.1).
  FiberState calcRigid(double activation, double path_length, double path_speed) const noexcept;

  /// State of a muscle with an elastic tendon: solves the balance for the fiber velocity
  ///   [a fAL fV(vN) + fPE + beta vN] cos(phi) = fT      (spec/muscle.md 6.2)
  /// which always has exactly one root.
  FiberState calcElastic(double activation, double fiber_length, double path_length) const noexcept;

  /// One of the two above, by the kind of tendon.
  FiberState calcState(double activation,
                       double fiber_length,
                       double path_length,
                       double path_speed) const noexcept {
    return rigid_ ? calcRigid(activation, path_length, path_speed)
                  : calcElastic(activation, fiber_length, path_length);
  }

  /// Tendon force of an elastic tendon [N]; no solve.
  double calcTendonForce(double fiber_length, double path_length) const noexcept;

  /// The same balance at the end of an implicit integration stage: the velocity v with
  ///   balance(l, v) = 0,  l = start_length + step v
  /// For step = 0 this is the velocity at `start_length`. Accurate to round-off. Where the fiber
  /// would pass its minimum length it stops there: step v = minFiberLength() - start_length.
  /// @param step   [s] >= 0, at most some 10 ms so that the balance stays monotone in v
  /// @param guess  [m/s] for speed only
  struct Stage {
    double activation;
    double start_length;
    double path_length;
    double step;
  };
  double solveStageVelocity(const Stage& stage, double guess) const noexcept;

  /// Fiber length at which an elastic muscle rests: [a fAL + fPE] cos(phi) = fT at zero velocity
  /// (spec/muscle.md 7). minFiberLength() if the path is too short for any tension.
  double solveStaticLength(double activation, double path_length) const noexcept;

  /// Tendon force with a rigid tendon as a function of activation: max(0, gain a + offset) [N].
  /// The gain is F0M fAL fV cos(phi), fV at activation 1 and not below 0, what cost functions call
  /// the active force at activation 1 (spec/muscle.md 8, with the pennation of the fiber); the
  /// offset is passive force and damping. Both are 0 at the minimum fiber length.
  struct ForceLine {
    double gain = 0;
    double offset = 0;
  };
  ForceLine calcRigidForceLine(double path_length, double path_speed) const noexcept;
  double calcRigidActiveForce(double path_length, double path_speed) const noexcept {
    return calcRigidForceLine(path_length, path_speed).gain;
  }

  // The normalised curves, force over F0M: of l/l0M, l/l0M, v/(l0M vmax) at activation 1, lT/lsT.
  CurvePoint calcActiveForceLength(double norm_length) const noexcept;
  CurvePoint calcPassiveForceLength(double norm_length) const noexcept;
  CurvePoint calcForceVelocity(double norm_velocity) const noexcept;
  CurvePoint calcTendonForceLength(double norm_tendon_length) const noexcept;
  /// Normalised length beyond which the tendon's curve is a line [lsT].
  double tendonLineStart() const noexcept;

 private:
  struct Geometry {
    double cos = 1;        ///< cos(phi)
    double cos_slope = 0;  ///< d cos(phi)/dl [1/m]
    double along = 0;      ///< l cos(phi) [m]
    double along_slope = 1;
  };
  struct Residual {
    double value;  ///< [-] fiber force along the tendon minus tendon force, over F0M
    double slope;  ///< d/dvN
  };
  void makeOwnCurves(const MuscleSpec& spec);
  Geometry calcGeometry(double fiber_length) const noexcept;
  double calcRigidLength(double path_length) const noexcept;
  double calcForceVelocityAt(double norm_velocity, double activation) const noexcept;
  template <class Curves>
  Residual calcStageResidual(const Curves& curves,
                             const Stage& stage,
                             double norm_velocity) const noexcept;
  template <class Curves>
  Residual calcStaticResidual(const Curves& curves,
                              double activation,
                              double fiber_length,
                              double path_length) const noexcept;
  template <class Curves>
  double findStaticLength(const Curves& curves,
                          double activation,
                          double path_length) const noexcept;
  /// function(curves) with the curves of the muscle's kind: one branch for a whole solve.
  template <class Function>
  auto withCurves(const Function& function) const noexcept;

  MuscleKind kind_ = MuscleKind::kMillard2012;
  std::shared_ptr<const MuscleCurves> curves_;    ///< of kMillard2012
  std::shared_ptr<const ThelenCurves> thelen_;    ///< of kThelen2003
  std::shared_ptr<const SchutteCurves> schutte_;  ///< of kSchutte1993
  ActivationDynamics activation_dynamics_;
  double max_force_ = 0;
  double optimal_length_ = 0;
  double slack_length_ = 0;
  double max_speed_ = 0;
  double damping_ = 0;
  double height_ = 0;  ///< h = l0M sin(alpha0) [m]
  double max_pennation_sin_ = 0;
  double max_pennation_cos_ = 0;
  double min_pennation_length_ = 0;  ///< fiber length at the maximum pennation [m]
  double min_length_ = 0;
  double minimum_activation_ = 0;
  bool rigid_ = false;
};

/// One Muscle per spec, in order. Each distinct set of Millard curves is built once and shared.
std::vector<Muscle> makeMuscles(const std::vector<MuscleSpec>& specs);

}  // namespace gaitmill

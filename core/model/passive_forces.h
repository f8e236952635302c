#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "core/data/expression.h"
#include "core/data/model_spec.h"
#include "core/math/scalar_function.h"
#include "core/model/model.h"

namespace gaitmill {

/// The passive forces of a model, resolved to indices. Constant after construction, may be shared
/// between threads. ModelState applies them wherever it computes dynamics, so that no stage can
/// forget them: they count as applied in inverse dynamics, too, as in OpenSim, and the moments that
/// it reports are what muscles and actuators must supply on top of them.
///
/// Limits: K(q) = stiffness S(overshoot / transition), S(x) = 10 x^3 - 15 x^4 + 6 x^5 from 0 to 1:
///   force = -K_up (q - upper) + K_low (lower - q) - damping (S_up + S_low) u
/// Bushings: force conjugate to each component of the deflection (body-fixed x-y-z angles and the
/// translation of frame 2 in frame 1) is minus stiffness, function or expression, minus damping
/// times its rate; equal and opposite on the two bodies. OpenSim 4 leaves out the damping that a
/// FunctionBasedBushingForce states; it is applied here.
class PassiveForces {
 public:
  /// @throws Error kModelReference, kInputCoordinates, kModelValue
  explicit PassiveForces(const Model& model);

  bool empty() const { return limits_.empty() && bushings_.empty(); }

  /// Adds generalized forces on coordinates, (n_coordinates) [N.m|N]. Needs setMotion.
  void addGeneralizedForces(const ModelState& state, Eigen::Ref<Eigen::VectorXd> forces) const;

  /// Adds wrenches on bodies, (6 x n_bodies): moment about the GROUND ORIGIN, force; in ground.
  /// Needs setMotion.
  void addBodyWrenches(const ModelState& state, Matrix6X& wrenches) const;

 private:
  /// A force on one coordinate that depends on its value and speed.
  struct OnCoordinate {
    PassiveForceSpec spec;
    int coordinate = 0;
    std::vector<Expression> expression;  ///< one, or none
  };
  struct Bushing {
    PassiveForceSpec spec;
    BodyIndex body1;
    BodyIndex body2;
    Pose X_B1F;                             ///< frame 1 on its body
    Pose X_B2M;                             ///< frame 2 on its body
    std::vector<ScalarFunction> functions;  ///< six, or none
    std::vector<Expression> expressions;    ///< six, or none
  };

  static double calcForce(const OnCoordinate& force, double q, double u);
  static Vector6 calcInternalForce(const Bushing& bushing, const Vector6& dq, const Vector6& rate);

  std::vector<OnCoordinate> limits_;
  std::vector<Bushing> bushings_;
};

}  // namespace gaitmill

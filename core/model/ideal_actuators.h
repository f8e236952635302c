#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/data/model_spec.h"
#include "core/model/free_coordinates.h"
#include "core/model/model.h"

namespace gaitmill {

/// Actuators whose force is control times optimal force, resolved on a model: residual forces and
/// torques at the pelvis, reserves and torque actuators at joints. One per thread.
class IdealActuators {
 public:
  /// Keeps a reference to `free`.
  /// @throws Error kModelReference, kInputCoordinates naming the body or coordinate not found;
  ///   kModelDuplicateName if two actuators have one name
  IdealActuators(const Model& model, const FreeCoordinates& free, std::vector<ActuatorSpec> specs);

  int count() const { return static_cast<int>(specs_.size()); }
  const std::vector<ActuatorSpec>& specs() const { return specs_; }
  const Eigen::VectorXd& optimalForces() const { return optimal_forces_; }  ///< [N|N.m]
  const Eigen::VectorXd& minForces() const { return min_forces_; }  ///< min control x optimal force
  const Eigen::VectorXd& maxForces() const { return max_forces_; }

  /// Generalized forces of unit forces at the pose of `state`: column k is d tau_free / d F_k,
  /// (free.count() x count()). Zero for an actuator on a locked coordinate. Does not allocate.
  void calcColumns(const ModelState& state, Eigen::Ref<Eigen::MatrixXd> columns);

  /// Appends what the point and torque actuators put on bodies at the given forces (count())
  /// [N|N.m]. Those on coordinates act across joints and add nothing.
  void addWrenches(const ModelState& state,
                   const Eigen::Ref<const Eigen::VectorXd>& forces,
                   std::vector<BodyWrench>& wrenches) const;

 private:
  struct Resolved {
    ActuatorSpec::Kind kind;
    CoordinateIndex coordinate;
    BodyIndex body;
    BodyIndex reaction_body;
  };
  /// Wrench of unit force on the actuator's body.
  BodyWrench calcUnitWrench(std::size_t k, const ModelState& state) const;

  const FreeCoordinates& free_;
  std::vector<ActuatorSpec> specs_;
  std::vector<Resolved> resolved_;
  Eigen::VectorXd optimal_forces_;
  Eigen::VectorXd min_forces_;
  Eigen::VectorXd max_forces_;
  Eigen::VectorXd tau_;  ///< all coordinates
};

}  // namespace gaitmill

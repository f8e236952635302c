#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/base/index.h"
#include "core/data/model_spec.h"

namespace gaitmill {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6X = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Pose of a frame B in ground: p_GP = R p_BP + p.
struct Pose {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Vector3d operator*(const Eigen::Vector3d& p_B) const { return R * p_B + p; }
};

/// Force and moment on one body, both in ground axes, the moment about the GROUND ORIGIN: a force F
/// at ground point p with torque T is {p x F + T, F}. So a ground reaction does not depend on the
/// pose.
struct BodyWrench {
  BodyIndex body;
  Vector6 wrench = Vector6::Zero();  ///< moment [N.m], then force [N]
};

/// The multibody tree of a ModelSpec, resolved to indices. Constant after construction, may be
/// shared between threads; everything that changes with time is in a ModelState. Coordinates are
/// numbered in document order (joint by joint), bodies, muscles and markers as in the spec.
class Model {
 public:
  /// @throws Error kModel... if references do not resolve, the joints do not form a tree, or a
  /// value is
  ///   unusable (mass, inertia that no body can have, non-linear coupler).
  explicit Model(ModelSpec spec);
  ~Model();
  Model(Model&&) noexcept;
  Model& operator=(Model&&) noexcept;
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  const ModelSpec& spec() const;
  int bodyCount() const;
  int coordinateCount() const;
  int muscleCount() const;

  const std::vector<std::string>& coordinateNames() const;
  const CoordinateSpec& coordinate(CoordinateIndex c) const;
  MotionKind motionKind(CoordinateIndex c) const;

  /// @throws Error kInputCoordinates / kModelReference naming the nearest name there is
  CoordinateIndex getCoordinate(const std::string& name) const;
  BodyIndex getBody(const std::string& name) const;  ///< "ground" gives kGround

  /// Whether moving coordinate `c` moves body `b` in ground. Always false for ground.
  bool isDistal(CoordinateIndex c, BodyIndex b) const;

  /// Default values (n_coordinates) [rad|m] with the couplers satisfied.
  const Eigen::VectorXd& defaultPose() const;

 private:
  friend class ModelState;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Kinematics and dynamics of a Model at one pose and speed. One per thread. Sizes its own memory
/// in the constructor; what is allocated later, Simbody allocates. Speeds are the coordinates' time
/// derivatives. Constraints (couplers, locks) play no role here: see FreeCoordinates. The model's
/// passive forces (core/model/passive_forces.h) act wherever forces are computed here.
class ModelState {
 public:
  explicit ModelState(const Model& model);  ///< keeps a reference to the model
  ~ModelState();
  ModelState(ModelState&&) noexcept;
  ModelState(const ModelState&) = delete;
  ModelState& operator=(const ModelState&) = delete;

  const Model& model() const;

  /// Poses, screws. @param q (n_coordinates) [rad|m], all of them, dependent ones included
  void setPose(const Eigen::Ref<const Eigen::VectorXd>& q);
  /// The same and velocities. @param u (n_coordinates) [rad/s|m/s]
  void setMotion(const Eigen::Ref<const Eigen::VectorXd>& q,
                 const Eigen::Ref<const Eigen::VectorXd>& u);

  const Eigen::VectorXd& q() const;
  const Eigen::VectorXd& u() const;

  /// X_GB. Ground gives the identity.
  const Pose& pose(BodyIndex body) const;

  /// Geometric Jacobian of everything at once, (6 x n_coordinates): column c holds the angular
  /// velocity and the velocity of the point at the GROUND ORIGIN that unit speed of coordinate c
  /// gives to all bodies distal to it. Velocity of a station at p_G on a distal body: v =
  /// screw.linear + w x p_G.
  const Matrix6X& screws() const;

  /// Velocity of the body as a screw at the ground origin (needs setMotion). Ground gives zero.
  Vector6 calcBodyVelocity(BodyIndex body) const;

  /// Generalized force that motion needs on the unconstrained tree (spec/id.md 1):
  ///   tau = M(q) udot + C(q,u) - G(q) - sum J^T F_ext - passive  (n_coordinates) [N.m|N]
  /// Needs setMotion. With udot = 0 this is the bias force.
  void calcInverseDynamics(const Eigen::Ref<const Eigen::VectorXd>& udot,
                           const std::vector<BodyWrench>& external,
                           Eigen::Ref<Eigen::VectorXd> tau);

  /// Wrench that the joint inboard of each body must put on that body, (6 x n_bodies), in ground,
  /// moment about the GROUND ORIGIN, then force: recursive Newton-Euler from the tips inward,
  ///   W_b = d/dt momentum_b - weight_b - external_b + sum over the joints it carries W_child
  /// Generalized forces act across joints and so belong to these wrenches; `external` holds all
  /// other forces on bodies. screws()^T W is the generalized force of calcInverseDynamics.
  /// Needs setMotion. Resizes `wrenches` on first use.
  void calcJointWrenches(const Eigen::Ref<const Eigen::VectorXd>& udot,
                         const std::vector<BodyWrench>& external,
                         Matrix6X& wrenches);

  /// Origin of a joint's frame on its child body, in ground [m]. Needs setPose.
  /// @param joint  position in ModelSpec::joints
  Eigen::Vector3d findJointCenter(int joint) const;

  /// Mass matrix, (n_coordinates x n_coordinates), both triangles. Needs setPose.
  void calcMassMatrix(Eigen::Ref<Eigen::MatrixXd> M) const;

  /// Generalized forces of a wrench on one body: adds J^T F to tau. Needs setPose.
  void addWrench(const BodyWrench& wrench, Eigen::Ref<Eigen::VectorXd> tau) const;

  /// Power of the model's passive forces [W]: below 0 while they store or take up energy. Needs
  /// setMotion.
  double calcPassivePower();

  double calcKineticEnergy() const;        ///< [J], needs setMotion
  double calcPotentialEnergy() const;      ///< [J] of gravity, zero at height 0
  Eigen::Vector3d calcMassCenter() const;  ///< of the whole body, in ground [m]

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gaitmill

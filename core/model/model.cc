#include "core/model/model.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Geometry>

#include "core/base/error.h"
#include "core/base/where.h"
#include "core/math/scalar_function.h"
#include "core/model/multibody_tree.h"
#include "core/model/passive_forces.h"
#include "core/model/topology.h"

namespace gaitmill {

namespace {

std::size_t at(BodyIndex body) {
  return static_cast<std::size_t>(body.value());
}
std::size_t at(CoordinateIndex c) {
  return static_cast<std::size_t>(c.value());
}

/// Mass, first and second moments of a body or a subtree about the ground origin, in ground axes.
/// In one common frame composite inertias simply add.
struct SpatialInertia {
  double mass = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();   ///< m c
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the ground origin

  void add(const SpatialInertia& other) {
    mass += other.mass;
    moment += other.moment;
    inertia += other.inertia;
  }

  /// Momentum (angular about the ground origin, linear) of motion with screw S.
  Vector6 multiply(const Eigen::Ref<const Vector6>& S) const {
    const Eigen::Vector3d w = S.head<3>();
    const Eigen::Vector3d v = S.tail<3>();
    Vector6 h;
    h.head<3>() = inertia * w + moment.cross(v);
    h.tail<3>() = mass * v + w.cross(moment);
    return h;
  }
};

Eigen::Matrix3d makeInertia(const std::array<double, 6>& I) {
  Eigen::Matrix3d matrix;
  matrix << I[0], I[3], I[4], I[3], I[1], I[5], I[4], I[5], I[2];
  return matrix;
}

SpatialInertia calcSpatialInertia(const BodySpec& body, const Pose& X_GB) {
  SpatialInertia result;
  const Eigen::Vector3d c = X_GB * body.mass_center;
  result.mass = body.mass;
  result.moment = body.mass * c;
  result.inertia = X_GB.R * makeInertia(body.inertia) * X_GB.R.transpose() +
                   body.mass * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
  return result;
}

/// Rate of change of the momentum of one body: angular about the ground origin, linear.
/// @param w             angular velocity [rad/s]
/// @param acceleration  angular, and of the body's origin
Vector6 calcMomentumRate(const BodySpec& body,
                         const Pose& X_GB,
                         const Eigen::Vector3d& w,
                         const Vector6& acceleration) {
  const Eigen::Vector3d alpha = acceleration.head<3>();
  const Eigen::Vector3d r = X_GB.R * body.mass_center;
  const Eigen::Vector3d a = acceleration.tail<3>() + alpha.cross(r) + w.cross(w.cross(r));
  const Eigen::Matrix3d I = X_GB.R * makeInertia(body.inertia) * X_GB.R.transpose();
  Vector6 rate;
  rate.tail<3>() = body.mass * a;
  rate.head<3>() = I * alpha + w.cross(I * w) + (X_GB.p + r).cross(body.mass * a);
  return rate;
}

}  // namespace

struct Model::Impl {
  ModelSpec spec;
  Topology topology;
  std::unique_ptr<MultibodyTree> tree;
  std::vector<MotionKind> motion_kinds;
  std::vector<char> distal;  ///< (n_coordinates x n_bodies)
  Eigen::VectorXd default_pose;
  std::unique_ptr<PassiveForces> passive_forces;

  const CoordinateSpec& coordinate(int c) const {
    const int j = topology.joint_of_coordinate[static_cast<std::size_t>(c)];
    const int slot = c - topology.joints[static_cast<std::size_t>(j)].first_coordinate;
    return spec.joints[static_cast<std::size_t>(j)].coordinates[static_cast<std::size_t>(slot)];
  }
};

Model::Model(ModelSpec spec) : impl_(std::make_unique<Impl>()) {
  impl_->spec = std::move(spec);
  impl_->topology = makeTopology(impl_->spec);
  impl_->tree = std::make_unique<MultibodyTree>(impl_->spec, impl_->topology);

  const int nq = coordinateCount();
  impl_->distal.assign(static_cast<std::size_t>(nq * bodyCount()), 0);
  for (int b = 0; b < bodyCount(); ++b) {
    for (const int c : impl_->topology.chain_of_body[static_cast<std::size_t>(b)]) {
      impl_->distal[static_cast<std::size_t>(c * bodyCount() + b)] = 1;
    }
  }
  impl_->default_pose.resize(nq);
  for (int c = 0; c < nq; ++c) {
    const int j = impl_->topology.joint_of_coordinate[static_cast<std::size_t>(c)];
    impl_->motion_kinds.push_back(findMotionKind(impl_->spec.joints[static_cast<std::size_t>(j)],
                                                 coordinateNames()[static_cast<std::size_t>(c)]));
    impl_->default_pose[c] = impl_->coordinate(c).default_value;
  }
  for (const CouplerSpec& coupler : impl_->spec.couplers) {
    if (coupler.enforced) {
      const int independent = getCoordinate(coupler.independent).value();
      impl_->default_pose[getCoordinate(coupler.dependent).value()] =
          coupler.scale *
          ScalarFunction(coupler.function).evaluate(impl_->default_pose[independent]).value;
    }
  }
  impl_->passive_forces = std::make_unique<PassiveForces>(*this);
}

Model::~Model() = default;
Model::Model(Model&&) noexcept = default;
Model& Model::operator=(Model&&) noexcept = default;

const ModelSpec& Model::spec() const {
  return impl_->spec;
}
int Model::bodyCount() const {
  return static_cast<int>(impl_->spec.bodies.size());
}
int Model::coordinateCount() const {
  return static_cast<int>(impl_->topology.coordinate_names.size());
}
int Model::muscleCount() const {
  return static_cast<int>(impl_->spec.muscles.size());
}
const std::vector<std::string>& Model::coordinateNames() const {
  return impl_->topology.coordinate_names;
}
const CoordinateSpec& Model::coordinate(CoordinateIndex c) const {
  return impl_->coordinate(c.value());
}
MotionKind Model::motionKind(CoordinateIndex c) const {
  return impl_->motion_kinds[at(c)];
}
const Eigen::VectorXd& Model::defaultPose() const {
  return impl_->default_pose;
}

CoordinateIndex Model::getCoordinate(const std::string& name) const {
  const std::vector<std::string>& names = coordinateNames();
  for (std::size_t c = 0; c < names.size(); ++c) {
    if (names[c] == name) {
      return CoordinateIndex(static_cast<int>(c));
    }
  }
  const std::string nearest = findNearestName(name, names);
  throw Error(ErrorCode::kInputCoordinates,
              "the model has no coordinate '" + name + "'" +
                  (nearest.empty() ? "" : "; the nearest is '" + nearest + "'"),
              atCoordinate(name));
}

BodyIndex Model::getBody(const std::string& name) const {
  if (name == "ground") {
    return kGround;
  }
  const auto found = impl_->topology.body_numbers.find(name);
  require(found != impl_->topology.body_numbers.end(),
          ErrorCode::kModelReference,
          "the model has no body '" + name + "'",
          {{}, 0, 0, name});
  return BodyIndex(found->second);
}

bool Model::isDistal(CoordinateIndex c, BodyIndex b) const {
  return b != kGround &&
         impl_->distal[static_cast<std::size_t>(c.value() * bodyCount() + b.value())] != 0;
}

struct ModelState::Impl {
  explicit Impl(const Model& m)
      : model(m),
        tree_state(m.impl_->tree->makeState()),
        q(Eigen::VectorXd::Zero(m.coordinateCount())),
        u(Eigen::VectorXd::Zero(m.coordinateCount())),
        poses(static_cast<std::size_t>(m.bodyCount())),
        screws(6, m.coordinateCount()),
        subtree_inertia(static_cast<std::size_t>(m.bodyCount())),
        subtree_wrench(6, m.bodyCount()),
        accelerations(6, m.bodyCount()),
        passive_tau(m.coordinateCount()),
        passive_wrenches(6, m.bodyCount()) {}

  const Model& model;
  std::unique_ptr<MultibodyTree::State> tree_state;
  Eigen::VectorXd q;
  Eigen::VectorXd u;
  std::vector<Pose> poses;
  Matrix6X screws;
  Pose ground;
  mutable std::vector<SpatialInertia> subtree_inertia;
  Matrix6X subtree_wrench;
  Matrix6X accelerations;
  Eigen::VectorXd passive_tau;
  Matrix6X passive_wrenches;

  /// Sets subtree_wrench to what gravity, external loads and passive forces put on each body alone.
  void loadBodies(const ModelState& state, const std::vector<BodyWrench>& external) {
    const ModelSpec& spec = model.spec();
    for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
      const Eigen::Vector3d weight = spec.bodies[b].mass * spec.gravity;
      auto wrench = subtree_wrench.col(static_cast<int>(b));
      wrench.head<3>() = (poses[b] * spec.bodies[b].mass_center).cross(weight);
      wrench.tail<3>() = weight;
    }
    for (const BodyWrench& load : external) {
      if (load.body != kGround) {
        subtree_wrench.col(load.body.value()) += load.wrench;
      }
    }
    model.impl_->passive_forces->addBodyWrenches(state, subtree_wrench);
  }

  const Topology& topology() const { return model.impl_->topology; }
};

ModelState::ModelState(const Model& model) : impl_(std::make_unique<Impl>(model)) {
  setPose(model.defaultPose());
}
ModelState::~ModelState() = default;
ModelState::ModelState(ModelState&&) noexcept = default;

const Model& ModelState::model() const {
  return impl_->model;
}
const Eigen::VectorXd& ModelState::q() const {
  return impl_->q;
}
const Eigen::VectorXd& ModelState::u() const {
  return impl_->u;
}
const Matrix6X& ModelState::screws() const {
  return impl_->screws;
}

const Pose& ModelState::pose(BodyIndex body) const {
  return body == kGround ? impl_->ground : impl_->poses[at(body)];
}

void ModelState::setPose(const Eigen::Ref<const Eigen::VectorXd>& q) {
  impl_->q = q;
  impl_->model.impl_->tree->calcPositions(*impl_->tree_state, q, impl_->poses, impl_->screws);
}

void ModelState::setMotion(const Eigen::Ref<const Eigen::VectorXd>& q,
                           const Eigen::Ref<const Eigen::VectorXd>& u) {
  setPose(q);
  impl_->u = u;
  impl_->model.impl_->tree->calcVelocities(*impl_->tree_state, u);
}

Vector6 ModelState::calcBodyVelocity(BodyIndex body) const {
  Vector6 velocity = Vector6::Zero();
  if (body != kGround) {
    for (const int c : impl_->topology().chain_of_body[at(body)]) {
      velocity += impl_->screws.col(c) * impl_->u[c];
    }
  }
  return velocity;
}

void ModelState::addWrench(const BodyWrench& wrench, Eigen::Ref<Eigen::VectorXd> tau) const {
  if (wrench.body == kGround) {
    return;
  }
  for (const int c : impl_->topology().chain_of_body[at(wrench.body)]) {
    tau[c] += impl_->screws.col(c).dot(wrench.wrench);
  }
}

void ModelState::calcInverseDynamics(const Eigen::Ref<const Eigen::VectorXd>& udot,
                                     const std::vector<BodyWrench>& external,
                                     Eigen::Ref<Eigen::VectorXd> tau) {
  impl_->model.impl_->tree->calcInertialForces(*impl_->tree_state, udot, tau);

  // Gravity and external wrenches, summed over subtrees from the tips inward, then projected.
  impl_->loadBodies(*this, external);
  const Topology& topology = impl_->topology();
  for (auto j = topology.outward.rbegin(); j != topology.outward.rend(); ++j) {
    const Topology::Joint& joint = topology.joints[static_cast<std::size_t>(*j)];
    const auto wrench = impl_->subtree_wrench.col(joint.child.value());
    for (int k = 0; k < joint.coordinate_count; ++k) {
      const int c = joint.first_coordinate + k;
      tau[c] -= impl_->screws.col(c).dot(wrench);
    }
    if (joint.parent != kGround) {
      impl_->subtree_wrench.col(joint.parent.value()) += wrench;
    }
  }
  if (!impl_->model.impl_->passive_forces->empty()) {
    impl_->passive_tau.setZero();
    impl_->model.impl_->passive_forces->addGeneralizedForces(*this, impl_->passive_tau);
    tau -= impl_->passive_tau;
  }
}

double ModelState::calcPassivePower() {
  impl_->passive_tau.setZero();
  impl_->passive_wrenches.setZero();
  impl_->model.impl_->passive_forces->addGeneralizedForces(*this, impl_->passive_tau);
  impl_->model.impl_->passive_forces->addBodyWrenches(*this, impl_->passive_wrenches);
  double power = impl_->passive_tau.dot(impl_->u);
  for (int b = 0; b < impl_->model.bodyCount(); ++b) {
    power += impl_->passive_wrenches.col(b).dot(calcBodyVelocity(BodyIndex(b)));
  }
  return power;
}

void ModelState::calcJointWrenches(const Eigen::Ref<const Eigen::VectorXd>& udot,
                                   const std::vector<BodyWrench>& external,
                                   Matrix6X& wrenches) {
  impl_->loadBodies(*this, external);
  impl_->model.impl_->tree->calcAccelerations(*impl_->tree_state, udot, impl_->accelerations);
  const ModelSpec& spec = impl_->model.spec();
  wrenches.resize(6, impl_->model.bodyCount());
  for (int b = 0; b < impl_->model.bodyCount(); ++b) {
    const auto i = static_cast<std::size_t>(b);
    const Vector6 velocity = calcBodyVelocity(BodyIndex(b));
    wrenches.col(b) = calcMomentumRate(
        spec.bodies[i], impl_->poses[i], velocity.head<3>(), impl_->accelerations.col(b));
  }
  wrenches -= impl_->subtree_wrench;
  const Topology& topology = impl_->topology();
  for (auto j = topology.outward.rbegin(); j != topology.outward.rend(); ++j) {
    const Topology::Joint& joint = topology.joints[static_cast<std::size_t>(*j)];
    if (joint.parent != kGround) {
      wrenches.col(joint.parent.value()) += wrenches.col(joint.child.value());
    }
  }
}

Eigen::Vector3d ModelState::findJointCenter(int joint) const {
  const auto j = static_cast<std::size_t>(joint);
  return pose(impl_->topology().joints[j].child) * impl_->model.spec().joints[j].child.translation;
}

void ModelState::calcMassMatrix(Eigen::Ref<Eigen::MatrixXd> M) const {
  // Composite rigid bodies, all about the ground origin: M_ij = S_i . (inertia beyond j) S_j for i
  // inboard of j. Cheaper than Simbody's column by column product.
  const Topology& topology = impl_->topology();
  const ModelSpec& spec = impl_->model.spec();
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    impl_->subtree_inertia[b] = calcSpatialInertia(spec.bodies[b], impl_->poses[b]);
  }
  M.setZero();
  for (auto j = topology.outward.rbegin(); j != topology.outward.rend(); ++j) {
    const Topology::Joint& joint = topology.joints[static_cast<std::size_t>(*j)];
    const SpatialInertia& inertia = impl_->subtree_inertia[at(joint.child)];
    for (int k = joint.first_coordinate; k < joint.first_coordinate + joint.coordinate_count; ++k) {
      const Vector6 momentum = inertia.multiply(impl_->screws.col(k));
      for (const int i : topology.chain_of_body[at(joint.child)]) {
        M(i, k) = impl_->screws.col(i).dot(momentum);
        M(k, i) = M(i, k);
      }
    }
    if (joint.parent != kGround) {
      impl_->subtree_inertia[at(joint.parent)].add(inertia);
    }
  }
}

double ModelState::calcKineticEnergy() const {
  double energy = 0;
  for (int b = 0; b < impl_->model.bodyCount(); ++b) {
    const auto i = static_cast<std::size_t>(b);
    const SpatialInertia inertia =
        calcSpatialInertia(impl_->model.spec().bodies[i], impl_->poses[i]);
    const Vector6 velocity = calcBodyVelocity(BodyIndex(b));
    energy += 0.5 * velocity.dot(inertia.multiply(velocity));
  }
  return energy;
}

double ModelState::calcPotentialEnergy() const {
  return -impl_->model.spec().calcTotalMass() * impl_->model.spec().gravity.dot(calcMassCenter());
}

Eigen::Vector3d ModelState::calcMassCenter() const {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double mass = 0;
  for (std::size_t b = 0; b < impl_->poses.size(); ++b) {
    const BodySpec& body = impl_->model.spec().bodies[b];
    moment += body.mass * (impl_->poses[b] * body.mass_center);
    mass += body.mass;
  }
  return moment / mass;
}

}  // namespace gaitmill

#include "core/model/multibody_tree.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Simbody.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/math/scalar_function.h"

namespace gaitmill {

namespace {

/// A ScalarFunction of one coordinate, or a constant of none, as Simbody wants it.
class SimbodyFunction : public SimTK::Function {
 public:
  SimbodyFunction(const FunctionSpec& spec, int argument_count)
      : function_(spec), argument_count_(argument_count) {}

  double calcValue(const SimTK::Vector& x) const override {
    return function_.evaluate(argument(x)).value;
  }
  double calcDerivative(const SimTK::Array_<int>& components,
                        const SimTK::Vector& x) const override {
    if (argument_count_ == 0) {
      return 0;
    }
    const ScalarFunction::Sample sample = function_.evaluate(argument(x));
    return components.size() == 1 ? sample.first : sample.second;
  }
  int getArgumentSize() const override { return argument_count_; }
  int getMaxDerivativeOrder() const override { return 2; }

 private:
  double argument(const SimTK::Vector& x) const { return argument_count_ == 0 ? 0.0 : x[0]; }

  ScalarFunction function_;
  int argument_count_;
};

SimTK::Vec3 toSimTK(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
Eigen::Vector3d toEigen(const SimTK::Vec3& v) {
  return {v[0], v[1], v[2]};
}

SimTK::Transform makeTransform(const FrameSpec& frame) {
  const SimTK::Rotation R(SimTK::BodyRotationSequence,
                          frame.orientation.x(),
                          SimTK::XAxis,
                          frame.orientation.y(),
                          SimTK::YAxis,
                          frame.orientation.z(),
                          SimTK::ZAxis);
  return {R, toSimTK(frame.translation)};
}

SimTK::Body::Rigid makeRigidBody(const BodySpec& body) {
  const Where where{{}, 0, 0, body.name};
  require(std::isfinite(body.mass) && body.mass >= 0,
          ErrorCode::kModelValue,
          "the mass of body '" + body.name + "' must be a number of kilograms >= 0, found " +
              std::to_string(body.mass),
          where);
  const auto& I = body.inertia;
  try {
    // The document states the inertia about the mass centre, Simbody takes it about the body
    // origin.
    const SimTK::Inertia central(SimTK::Vec3(I[0], I[1], I[2]), SimTK::Vec3(I[3], I[4], I[5]));
    const SimTK::Vec3 center = toSimTK(body.mass_center);
    return SimTK::Body::Rigid(
        SimTK::MassProperties(body.mass, center, central.shiftFromMassCenter(center, body.mass)));
  } catch (const SimTK::Exception::Base&) {
    throw Error(ErrorCode::kModelValue,
                "no body can have the inertia of '" + body.name + "': of its moments " +
                    formatFixed(I[0], 6) + ", " + formatFixed(I[1], 6) + " and " +
                    formatFixed(I[2], 6) +
                    " kg m^2 two must not sum to less than the third (the toes of Rajagopal2015 "
                    "have 0.0002 where Rajagopal2016 corrects it to 0.0011)",
                where);
  }
}

/// Pin, slider, universal, planar and gimbal joints as the six axes of a custom joint.
std::array<TransformAxisSpec, 6> makeAxes(const JointSpec& joint) {
  if (joint.kind == JointSpec::Kind::kCustom) {
    return joint.axes;
  }
  std::array<TransformAxisSpec, 6> axes;
  for (std::size_t i = 0; i < 6; ++i) {
    axes[i].axis = Eigen::Vector3d::Unit(static_cast<int>(i % 3));
  }
  const auto drive = [&](std::size_t slot, std::size_t coordinate) {
    axes[slot].coordinate = joint.coordinates.at(coordinate).name;
    axes[slot].function = {FunctionSpec::Kind::kLinear, {}, {1, 0}, 1};
  };
  switch (joint.kind) {
    case JointSpec::Kind::kPin:
      drive(2, 0);
      break;
    case JointSpec::Kind::kSlider:
      drive(3, 0);
      break;
    case JointSpec::Kind::kUniversal:
      drive(0, 0);
      drive(1, 1);
      break;
    case JointSpec::Kind::kPlanar:
      drive(2, 0);
      drive(3, 1);
      drive(4, 2);
      break;
    case JointSpec::Kind::kGimbal:
      drive(0, 0);
      drive(1, 1);
      drive(2, 2);
      break;
    case JointSpec::Kind::kWeld:
    case JointSpec::Kind::kCustom:
      break;
  }
  return axes;
}

SimTK::MobilizedBody addFunctionBased(SimTK::MobilizedBody& parent,
                                      const SimTK::Transform& X_PF,
                                      const SimTK::Body& body,
                                      const SimTK::Transform& X_BM,
                                      const JointSpec& joint) {
  SimTK::Array_<const SimTK::Function*> functions;
  SimTK::Array_<SimTK::Array_<int>> coordinates;
  SimTK::Array_<SimTK::Vec3> directions;
  for (const TransformAxisSpec& axis : makeAxes(joint)) {
    SimTK::Array_<int> arguments;
    for (std::size_t k = 0; k < joint.coordinates.size(); ++k) {
      if (joint.coordinates[k].name == axis.coordinate) {
        arguments.push_back(static_cast<int>(k));
      }
    }
    require(axis.coordinate.empty() || !arguments.empty(),
            ErrorCode::kModelReference,
            "an axis of joint '" + joint.name + "' is driven by '" + axis.coordinate +
                "', which is not a coordinate of that joint",
            {{}, 0, 0, joint.name});
    require(axis.axis.norm() > 1e-12,
            ErrorCode::kModelValue,
            "an axis of joint '" + joint.name + "' has no direction",
            {{}, 0, 0, joint.name});
    // Simbody takes ownership of the functions.
    functions.push_back(new SimbodyFunction(axis.function, static_cast<int>(arguments.size())));
    coordinates.push_back(arguments);
    directions.push_back(toSimTK(axis.axis.normalized()));
  }
  return SimTK::MobilizedBody::FunctionBased(parent,
                                             X_PF,
                                             body,
                                             X_BM,
                                             static_cast<int>(joint.coordinates.size()),
                                             functions,
                                             coordinates,
                                             directions);
}

/// Three rotations about coordinate axes, one coordinate each, and three translations that are
/// either zero or one coordinate each: what hips, shoulders, back and pelvis are. Simbody has
/// mobilizers for these that need no function calls, several times faster than the function-based
/// one.
struct SimpleJoint {
  SimTK::Rotation axes;  ///< columns: directions of the three rotations, right-handed
  std::array<int, 6> coordinate{{-1, -1, -1, -1, -1, -1}};
  std::array<double, 6> sign{};
  bool translates = false;
};

/// Number and sign of the coordinate that drives an axis one to one, along a unit vector; -1 =
/// none.
int findDrivenAxis(const JointSpec& joint,
                   const TransformAxisSpec& axis,
                   int& direction,
                   double& sign) {
  const FunctionSpec& f = axis.function;
  Eigen::Vector3d::Index largest = 0;
  axis.axis.cwiseAbs().maxCoeff(&largest);
  const bool aligned = axis.axis.cwiseAbs().isApprox(Eigen::Vector3d::Unit(largest), 1e-15);
  if (f.kind != FunctionSpec::Kind::kLinear || std::abs(f.scale * f.y.at(0)) != 1.0 ||
      f.y.at(1) != 0.0 || !aligned) {
    return -1;
  }
  direction = static_cast<int>(largest);
  sign = f.scale * f.y[0] * (axis.axis[largest] > 0 ? 1.0 : -1.0);
  for (std::size_t k = 0; k < joint.coordinates.size(); ++k) {
    if (joint.coordinates[k].name == axis.coordinate) {
      return static_cast<int>(k);
    }
  }
  return -1;
}

bool isZero(const TransformAxisSpec& axis) {
  return axis.coordinate.empty() && axis.function.kind == FunctionSpec::Kind::kConstant &&
         axis.function.scale * axis.function.y.at(0) == 0.0;
}

std::optional<SimpleJoint> findSimpleJoint(const JointSpec& joint) {
  const std::array<TransformAxisSpec, 6> axes = makeAxes(joint);
  SimpleJoint simple;
  std::array<int, 3> direction{};
  for (std::size_t i = 0; i < 3; ++i) {
    simple.coordinate[i] = findDrivenAxis(joint, axes[i], direction[i], simple.sign[i]);
  }
  const bool permutes =
      direction[0] != direction[1] && direction[1] != direction[2] && direction[0] != direction[2];
  simple.translates = !(isZero(axes[3]) && isZero(axes[4]) && isZero(axes[5]));
  for (std::size_t i = 3; simple.translates && i < 6; ++i) {
    int along = -1;
    double sign = 0;
    const int coordinate = findDrivenAxis(joint, axes[i], along, sign);
    if (coordinate >= 0) {
      simple.coordinate[static_cast<std::size_t>(3 + along)] = coordinate;
      simple.sign[static_cast<std::size_t>(3 + along)] = sign;
    }
  }
  // Every coordinate drives exactly one axis.
  std::size_t driven = 0;
  std::vector<bool> used(joint.coordinates.size(), false);
  for (const int coordinate : simple.coordinate) {
    if (coordinate >= 0 && !used[static_cast<std::size_t>(coordinate)]) {
      used[static_cast<std::size_t>(coordinate)] = true;
      ++driven;
    }
  }
  const std::size_t wanted = simple.translates ? 6 : 3;
  if (!permutes || driven != wanted || joint.coordinates.size() != wanted) {
    return std::nullopt;
  }
  Eigen::Matrix3d columns = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i) {
    columns(direction[static_cast<std::size_t>(i)], i) = 1.0;
  }
  if (columns.determinant() < 0) {
    columns.col(2) = -columns.col(2);
    simple.sign[2] = -simple.sign[2];
  }
  const Eigen::Matrix3d& m = columns;
  simple.axes = SimTK::Rotation(
      SimTK::Mat33(m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)),
      true);
  return simple;
}

/// One coordinate on the Simbody side.
struct Hinge {
  SimTK::MobilizedBodyIndex mobod;
  int slot = 0;     ///< its place in the mobilizer
  double sign = 1;  ///< Simbody's q = sign * coordinate
  int body = -1;    ///< model body that moves
  int u = -1;       ///< Simbody's number of the speed
};

SimTK::MobilizedBodyIndex addSimpleJoint(SimTK::MobilizedBody& parent,
                                         const BodySpec& spec,
                                         const JointSpec& joint,
                                         const SimpleJoint& simple,
                                         std::vector<Hinge>& hinges) {
  SimTK::Transform X_PF = makeTransform(joint.parent);
  SimTK::MobilizedBodyIndex carrier = parent.getMobilizedBodyIndex();
  if (simple.translates) {
    // A body without mass in between: allowed, since accelerations are never solved by Simbody
    // here.
    carrier =
        SimTK::MobilizedBody::Translation(parent, X_PF, SimTK::Body::Massless(), SimTK::Transform())
            .getMobilizedBodyIndex();
    X_PF = SimTK::Transform();
  }
  SimTK::MobilizedBody& inboard = parent.updMatterSubsystem().updMobilizedBody(carrier);
  const SimTK::Transform turn(simple.axes);
  const SimTK::MobilizedBodyIndex index =
      SimTK::MobilizedBody::Gimbal(
          inboard, X_PF * turn, makeRigidBody(spec), makeTransform(joint.child) * turn)
          .getMobilizedBodyIndex();
  for (int i = 0; i < 6; ++i) {
    const auto slot = static_cast<std::size_t>(i);
    if (simple.coordinate[slot] >= 0) {
      hinges[static_cast<std::size_t>(simple.coordinate[slot])] = {
          i < 3 ? index : carrier, i % 3, simple.sign[slot]};
    }
  }
  return index;
}

SimTK::MobilizedBody addMobilizer(SimTK::MobilizedBody& parent,
                                  const BodySpec& spec,
                                  const JointSpec& joint) {
  const SimTK::Body::Rigid body = makeRigidBody(spec);
  const SimTK::Transform X_PF = makeTransform(joint.parent);
  const SimTK::Transform X_BM = makeTransform(joint.child);
  const auto expected = [&](std::size_t count) {
    require(joint.coordinates.size() == count,
            ErrorCode::kModelValue,
            "joint '" + joint.name + "' needs " + std::to_string(count) + " coordinates, found " +
                std::to_string(joint.coordinates.size()),
            {{}, 0, 0, joint.name});
  };
  switch (joint.kind) {
    case JointSpec::Kind::kWeld:
      expected(0);
      return SimTK::MobilizedBody::Weld(parent, X_PF, body, X_BM);
    case JointSpec::Kind::kPin:
      expected(1);
      return SimTK::MobilizedBody::Pin(parent, X_PF, body, X_BM);
    case JointSpec::Kind::kSlider:
      expected(1);
      return SimTK::MobilizedBody::Slider(parent, X_PF, body, X_BM);
    case JointSpec::Kind::kUniversal:
      expected(2);
      return SimTK::MobilizedBody::Universal(parent, X_PF, body, X_BM);
    case JointSpec::Kind::kPlanar:
    case JointSpec::Kind::kGimbal:
      expected(3);
      break;
    case JointSpec::Kind::kCustom:
      break;
  }
  return addFunctionBased(parent, X_PF, body, X_BM, joint);
}

}  // namespace

struct MultibodyTree::Impl {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  std::vector<SimTK::MobilizedBodyIndex> mobods;  ///< by body
  std::vector<Hinge> hinges;                      ///< by coordinate
  SimTK::State initial;
};

struct MultibodyTree::State::Impl {
  SimTK::State state;
  SimTK::Vector udot;
  SimTK::Vector tau;
  SimTK::Vector no_mobility_forces;
  SimTK::Vector_<SimTK::SpatialVec> no_body_forces;
  SimTK::Vector_<SimTK::SpatialVec> accelerations;

  void setAcceleration(const std::vector<Hinge>& hinges,
                       const Eigen::Ref<const Eigen::VectorXd>& values) {
    for (std::size_t c = 0; c < hinges.size(); ++c) {
      udot[hinges[c].u] = hinges[c].sign * values[static_cast<int>(c)];
    }
  }
};

void MultibodyTree::addJoint(Impl& impl,
                             const ModelSpec& spec,
                             const Topology& topology,
                             std::size_t j) {
  const Topology::Joint& joint = topology.joints[j];
  const auto child = static_cast<std::size_t>(joint.child.value());
  SimTK::MobilizedBody& parent =
      joint.parent == kGround ? static_cast<SimTK::MobilizedBody&>(impl.matter.Ground())
                              : impl.matter.updMobilizedBody(
                                    impl.mobods[static_cast<std::size_t>(joint.parent.value())]);
  std::vector<Hinge> hinges(static_cast<std::size_t>(joint.coordinate_count));
  if (const std::optional<SimpleJoint> simple = findSimpleJoint(spec.joints[j])) {
    impl.mobods[child] =
        addSimpleJoint(parent, spec.bodies[child], spec.joints[j], *simple, hinges);
  } else {
    impl.mobods[child] =
        addMobilizer(parent, spec.bodies[child], spec.joints[j]).getMobilizedBodyIndex();
    for (std::size_t k = 0; k < hinges.size(); ++k) {
      hinges[k] = {impl.mobods[child], static_cast<int>(k), 1.0};
    }
  }
  for (std::size_t k = 0; k < hinges.size(); ++k) {
    hinges[k].body = joint.child.value();
    impl.hinges[static_cast<std::size_t>(joint.first_coordinate) + k] = hinges[k];
  }
}

MultibodyTree::State::State() : impl_(std::make_unique<Impl>()) {}
MultibodyTree::State::~State() = default;

MultibodyTree::MultibodyTree(const ModelSpec& spec, const Topology& topology)
    : impl_(std::make_unique<Impl>()) {
  impl_->mobods.resize(spec.bodies.size());
  impl_->hinges.resize(topology.coordinate_names.size());
  for (const int j : topology.outward) {
    addJoint(*impl_, spec, topology, static_cast<std::size_t>(j));
  }
  impl_->initial = impl_->system.realizeTopology();
  impl_->system.realizeModel(impl_->initial);
  for (Hinge& hinge : impl_->hinges) {
    hinge.u = int(impl_->matter.getMobilizedBody(hinge.mobod).getFirstUIndex(impl_->initial)) +
              hinge.slot;
  }
}

MultibodyTree::~MultibodyTree() = default;

std::unique_ptr<MultibodyTree::State> MultibodyTree::makeState() const {
  std::unique_ptr<State> state(new State);
  state->impl_->state = impl_->initial;
  state->impl_->udot.resize(impl_->initial.getNU());
  state->impl_->tau.resize(impl_->initial.getNU());
  return state;
}

void MultibodyTree::calcPositions(State& state,
                                  const Eigen::Ref<const Eigen::VectorXd>& q,
                                  std::vector<Pose>& poses,
                                  Matrix6X& screws) const {
  SimTK::State& s = state.impl_->state;
  SimTK::Vector& target = s.updQ();
  for (std::size_t c = 0; c < impl_->hinges.size(); ++c) {
    // Every mobilizer here has as many q as u, in the same order.
    target[impl_->hinges[c].u] = impl_->hinges[c].sign * q[static_cast<int>(c)];
  }
  impl_->system.realize(s, SimTK::Stage::Position);
  for (std::size_t b = 0; b < poses.size(); ++b) {
    const SimTK::Transform& X_GB =
        impl_->matter.getMobilizedBody(impl_->mobods[b]).getBodyTransform(s);
    const SimTK::Mat33& R = X_GB.R().asMat33();
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        poses[b].R(row, column) = R(row, column);
      }
    }
    poses[b].p = toEigen(X_GB.p());
  }
  for (std::size_t c = 0; c < impl_->hinges.size(); ++c) {
    const Hinge& hinge = impl_->hinges[c];
    const SimTK::SpatialVec h =
        impl_->matter.getMobilizedBody(hinge.mobod).getHCol(s, SimTK::MobilizerUIndex(hinge.slot));
    const Eigen::Vector3d w = hinge.sign * toEigen(h[0]);
    // The carrier of a translation does not turn, so the body's own origin serves for all hinges.
    const Eigen::Vector3d v =
        hinge.sign * toEigen(h[1]) - w.cross(poses[static_cast<std::size_t>(hinge.body)].p);
    screws.col(static_cast<int>(c)) << w, v;
  }
}

void MultibodyTree::calcVelocities(State& state, const Eigen::Ref<const Eigen::VectorXd>& u) const {
  SimTK::State& s = state.impl_->state;
  SimTK::Vector& target = s.updU();
  for (std::size_t c = 0; c < impl_->hinges.size(); ++c) {
    target[impl_->hinges[c].u] = impl_->hinges[c].sign * u[static_cast<int>(c)];
  }
  impl_->system.realize(s, SimTK::Stage::Velocity);
}

void MultibodyTree::calcInertialForces(State& state,
                                       const Eigen::Ref<const Eigen::VectorXd>& udot,
                                       Eigen::Ref<Eigen::VectorXd> tau) const {
  State::Impl& work = *state.impl_;
  work.setAcceleration(impl_->hinges, udot);
  impl_->matter.calcResidualForceIgnoringConstraints(
      work.state, work.no_mobility_forces, work.no_body_forces, work.udot, work.tau);
  for (std::size_t c = 0; c < impl_->hinges.size(); ++c) {
    tau[static_cast<int>(c)] = impl_->hinges[c].sign * work.tau[impl_->hinges[c].u];
  }
}

void MultibodyTree::calcAccelerations(State& state,
                                      const Eigen::Ref<const Eigen::VectorXd>& udot,
                                      Matrix6X& accelerations) const {
  State::Impl& work = *state.impl_;
  work.setAcceleration(impl_->hinges, udot);
  impl_->matter.calcBodyAccelerationFromUDot(work.state, work.udot, work.accelerations);
  for (std::size_t b = 0; b < impl_->mobods.size(); ++b) {
    const SimTK::SpatialVec& A = work.accelerations[int(impl_->mobods[b])];
    accelerations.col(static_cast<int>(b)) << toEigen(A[0]), toEigen(A[1]);
  }
}

}  // namespace gaitmill

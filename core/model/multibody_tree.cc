#include "core/model/multibody_tree.h"

#include <cstddef>
#include <string>

#include <Eigen/Geometry>
#include <Simbody.h>

#include "core/base/error.h"
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
  } catch (const SimTK::Exception::Base& error) {
    throw Error(ErrorCode::kModelValue,
                "the inertia of body '" + body.name + "' cannot be that of a body: " + error.what(),
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
  std::vector<int> simbody_u;                     ///< Simbody's number of each coordinate
  std::vector<int> coordinate_body;               ///< child body of each coordinate's joint
  std::vector<int> coordinate_slot;               ///< its place in the mobilizer
  SimTK::State initial;
};

struct MultibodyTree::State::Impl {
  SimTK::State state;
  SimTK::Vector udot;
  SimTK::Vector tau;
  SimTK::Vector no_mobility_forces;
  SimTK::Vector_<SimTK::SpatialVec> no_body_forces;
};

MultibodyTree::State::State() : impl_(std::make_unique<Impl>()) {}
MultibodyTree::State::~State() = default;

MultibodyTree::MultibodyTree(const ModelSpec& spec, const Topology& topology)
    : impl_(std::make_unique<Impl>()) {
  impl_->mobods.resize(spec.bodies.size());
  for (const int j : topology.outward) {
    const Topology::Joint& joint = topology.joints[static_cast<std::size_t>(j)];
    const auto child = static_cast<std::size_t>(joint.child.value());
    SimTK::MobilizedBody& parent =
        joint.parent == kGround
            ? static_cast<SimTK::MobilizedBody&>(impl_->matter.Ground())
            : impl_->matter.updMobilizedBody(
                  impl_->mobods[static_cast<std::size_t>(joint.parent.value())]);
    impl_->mobods[child] =
        addMobilizer(parent, spec.bodies[child], spec.joints[static_cast<std::size_t>(j)])
            .getMobilizedBodyIndex();
  }
  impl_->initial = impl_->system.realizeTopology();
  impl_->system.realizeModel(impl_->initial);
  for (std::size_t j = 0; j < spec.joints.size(); ++j) {
    const Topology::Joint& joint = topology.joints[j];
    const auto body = static_cast<std::size_t>(joint.child.value());
    const SimTK::MobilizedBody& mobod = impl_->matter.getMobilizedBody(impl_->mobods[body]);
    for (int k = 0; k < joint.coordinate_count; ++k) {
      impl_->simbody_u.push_back(int(mobod.getFirstUIndex(impl_->initial)) + k);
      impl_->coordinate_body.push_back(joint.child.value());
      impl_->coordinate_slot.push_back(k);
    }
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
  for (int c = 0; c < static_cast<int>(impl_->simbody_u.size()); ++c) {
    // Every mobilizer here has as many q as u, in the same order.
    target[impl_->simbody_u[static_cast<std::size_t>(c)]] = q[c];
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
  for (int c = 0; c < static_cast<int>(screws.cols()); ++c) {
    const auto i = static_cast<std::size_t>(c);
    const auto body = static_cast<std::size_t>(impl_->coordinate_body[i]);
    const SimTK::SpatialVec h = impl_->matter.getMobilizedBody(impl_->mobods[body])
                                    .getHCol(s, SimTK::MobilizerUIndex(impl_->coordinate_slot[i]));
    const Eigen::Vector3d w = toEigen(h[0]);
    screws.col(c).head<3>() = w;
    screws.col(c).tail<3>() = toEigen(h[1]) - w.cross(poses[body].p);
  }
}

void MultibodyTree::calcVelocities(State& state, const Eigen::Ref<const Eigen::VectorXd>& u) const {
  SimTK::State& s = state.impl_->state;
  SimTK::Vector& target = s.updU();
  for (int c = 0; c < static_cast<int>(impl_->simbody_u.size()); ++c) {
    target[impl_->simbody_u[static_cast<std::size_t>(c)]] = u[c];
  }
  impl_->system.realize(s, SimTK::Stage::Velocity);
}

void MultibodyTree::calcInertialForces(State& state,
                                       const Eigen::Ref<const Eigen::VectorXd>& udot,
                                       Eigen::Ref<Eigen::VectorXd> tau) const {
  State::Impl& work = *state.impl_;
  for (int c = 0; c < static_cast<int>(impl_->simbody_u.size()); ++c) {
    work.udot[impl_->simbody_u[static_cast<std::size_t>(c)]] = udot[c];
  }
  impl_->matter.calcResidualForceIgnoringConstraints(
      work.state, work.no_mobility_forces, work.no_body_forces, work.udot, work.tau);
  for (int c = 0; c < static_cast<int>(impl_->simbody_u.size()); ++c) {
    tau[c] = work.tau[impl_->simbody_u[static_cast<std::size_t>(c)]];
  }
}

}  // namespace gaitmill

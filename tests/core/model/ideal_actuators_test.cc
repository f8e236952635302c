#include "core/model/ideal_actuators.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

// A rod on a pin about the ground's z axis, and a second one on it whose joint is locked.
ModelSpec makeRods() {
  ModelSpec spec;
  BodySpec body;
  body.mass = 1;
  body.inertia = {0.1, 0.1, 0.1, 0, 0, 0};
  const auto add = [&](const char* name, const char* parent, const char* coordinate, bool locked) {
    body.name = name;
    spec.bodies.push_back(body);
    JointSpec joint;
    joint.name = std::string(name) + "_joint";
    joint.kind = JointSpec::Kind::kPin;
    joint.parent.body = parent;
    joint.child.body = name;
    CoordinateSpec c;
    c.name = coordinate;
    c.locked = locked;
    joint.coordinates.push_back(c);
    spec.joints.push_back(joint);
  };
  add("upper", "ground", "swing", false);
  add("lower", "upper", "fixed", true);
  return spec;
}

ActuatorSpec makePointForce(bool in_ground) {
  ActuatorSpec force;
  force.name = "FX";
  force.kind = ActuatorSpec::Kind::kPoint;
  force.body = "upper";
  force.point = {0, -0.5, 0};
  force.direction_in_ground = in_ground;
  return force;
}

double calcColumn(const ActuatorSpec& actuator, double angle) {
  const Model model(makeRods());
  const FreeCoordinates free(model);
  IdealActuators actuators(model, free, {actuator});
  ModelState state(model);
  Eigen::Vector2d q(angle, 0);
  state.setPose(q);
  Eigen::MatrixXd columns(free.count(), 1);
  actuators.calcColumns(state, columns);
  return columns(0, 0);
}

TEST(IdealActuators, ForceInGroundAxesHasTheLeverOfItsPoint) {
  EXPECT_NEAR(calcColumn(makePointForce(true), 0.3), 0.5 * std::cos(0.3), tol(1e-15));
}

TEST(IdealActuators, ForceInBodyAxesTurnsWithTheBody) {
  EXPECT_NEAR(calcColumn(makePointForce(false), 0.3), 0.5, tol(1e-15));
}

TEST(IdealActuators, TorqueBetweenTwoBodiesOfOneRigidChainDoesNothing) {
  ActuatorSpec torque;
  torque.name = "MZ";
  torque.kind = ActuatorSpec::Kind::kTorque;
  torque.body = "lower";
  torque.direction = Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(calcColumn(torque, 0.3), 1, tol(1e-15));
  torque.reaction_body = "upper";
  EXPECT_NEAR(calcColumn(torque, 0.3), 0, tol(1e-15));
}

TEST(IdealActuators, ReserveIsAUnitColumnAndZeroOnALockedCoordinate) {
  ActuatorSpec reserve;
  reserve.name = "reserve";
  reserve.coordinate = "swing";
  EXPECT_EQ(calcColumn(reserve, 0.3), 1);
  reserve.coordinate = "fixed";
  EXPECT_EQ(calcColumn(reserve, 0.3), 0);
}

TEST(IdealActuators, RefusesTwoOfOneName) {
  const Model model(makeRods());
  const FreeCoordinates free(model);
  try {
    IdealActuators(model, free, {makePointForce(true), makePointForce(false)});
    FAIL() << "did not throw";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kModelDuplicateName);
  }
}

// A torque between two bodies pulls both ways; what acts on a coordinate is no force on a body.
TEST(IdealActuators, WrenchesGiveTheSameGeneralizedForcesAsTheColumns) {
  ActuatorSpec torque;
  torque.name = "twist";
  torque.kind = ActuatorSpec::Kind::kTorque;
  torque.body = "lower";
  torque.reaction_body = "upper";
  torque.direction = {0.6, 0, 0.8};
  ActuatorSpec reserve;
  reserve.name = "swing_reserve";
  reserve.coordinate = "swing";
  const Model model(makeRods());
  const FreeCoordinates free(model);
  IdealActuators actuators(model, free, {makePointForce(false), torque, reserve});
  ModelState state(model);
  state.setPose(Eigen::Vector2d(0.4, 0));
  const Eigen::Vector3d forces(7, -2, 5);
  std::vector<BodyWrench> wrenches;
  actuators.addWrenches(state, forces, wrenches);
  ASSERT_EQ(wrenches.size(), 3U);
  Eigen::VectorXd tau = Eigen::VectorXd::Zero(2);
  for (const BodyWrench& wrench : wrenches) {
    state.addWrench(wrench, tau);
  }
  Eigen::MatrixXd columns(1, 3);
  actuators.calcColumns(state, columns);
  const double without_reserve = columns(0, 0) * forces[0] + columns(0, 1) * forces[1];
  EXPECT_NEAR(tau[0], without_reserve, tol(1e-14));
}

}  // namespace
}  // namespace gaitmill

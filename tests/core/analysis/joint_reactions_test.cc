// Joint reactions of systems small enough for a closed form.
#include "core/analysis/joint_reactions.h"

#include <cmath>
#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/simple_models.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr double kMass = 2.0;    // [kg]
constexpr double kLength = 0.4;  // [m]

/// What the pendulum does and what drives it.
struct Swing {
  double angle = 0;    // [rad]
  double speed = 0;    // [rad/s]
  double torque = 0;   // at the pin [N.m]
  double tension = 0;  // of a muscle from above the pin to the bob [N]
};

ModelSpec makeDrivenPendulum() {
  ModelSpec spec = makePendulum(kMass, kLength);
  MuscleSpec muscle;
  muscle.name = "lifter";
  muscle.max_isometric_force = 1000;
  muscle.optimal_fiber_length = 0.1;
  muscle.tendon_slack_length = 0.35;
  muscle.path = {{"ground", {0, 0.1, 0}}, {"bob", {0, -kLength, 0}}};
  spec.muscles.push_back(muscle);
  return spec;
}

TimeSeries makeCell(const std::string& label, double value) {
  TimeSeries table = makeTimeSeries(label, {label}, {0.0});
  table.values(0, 0) = value;
  return table;
}

TimeSeries calcReaction(const Swing& swing, const ModelSpec& spec = makeDrivenPendulum()) {
  const Model model(spec);
  ActuatorSpec motor;
  motor.name = "motor";
  motor.coordinate = "angle";
  const TimeSeries pose = makeCell("angle", swing.angle);
  const TimeSeries speed = makeCell("angle", swing.speed);
  const TimeSeries tension = makeCell("lifter", swing.tension);
  const TimeSeries torque = makeCell("motor", swing.torque);
  const ExternalLoads nothing(model, {});
  return calcJointReactions(model, {pose, speed, tension, torque, {motor}, nothing});
}

double read(const TimeSeries& table, const std::string& component) {
  return table.values(0, table.getColumn("pin_on_bob_in_" + component));
}

// The rod pulls the bob in: m (l u^2 + g cos q). A free pin transmits nothing else.
TEST(JointReactions, OfAFreePendulumPointAlongTheRod) {
  const Swing swing{0.7, -1.1, 0, 0};
  const TimeSeries reaction = calcReaction(swing);
  const double pull = kMass * (kLength * 1.1 * 1.1 + kGravity * std::cos(0.7));
  EXPECT_NEAR(read(reaction, "bob_fx"), 0, tol(1e-13));
  EXPECT_NEAR(read(reaction, "bob_fy"), pull, tol(1e-13));
  EXPECT_NEAR(read(reaction, "bob_mz"), 0, tol(1e-13));
  EXPECT_NEAR(read(reaction, "ground_fx"), -pull * std::sin(0.7), tol(1e-13));
  EXPECT_NEAR(read(reaction, "ground_fy"), pull * std::cos(0.7), tol(1e-13));
  EXPECT_EQ(read(reaction, "bob_py"), 0);
}

// A motor at the pin is part of what the joint transmits: T, and T / l across the rod.
TEST(JointReactions, HoldWhatAMotorAcrossTheJointDoes) {
  const TimeSeries reaction = calcReaction({0.7, 0, 1.6, 0});
  EXPECT_NEAR(read(reaction, "bob_mz"), 1.6, tol(1e-13));
  EXPECT_NEAR(read(reaction, "bob_fx"), 1.6 / kLength, tol(1e-13));
  EXPECT_NEAR(read(reaction, "bob_fy"), kMass * kGravity * std::cos(0.7), tol(1e-13));
}

// Hanging at rest: a muscle along the rod takes weight off the pin, and more tension presses the
// bob against it.
TEST(JointReactions, AMuscleAcrossTheJointCompressesIt) {
  const TimeSeries reaction = calcReaction({0, 0, 0, 100});
  EXPECT_NEAR(read(reaction, "bob_fy"), kMass * kGravity - 100, tol(1e-12));
  EXPECT_NEAR(read(reaction, "bob_fx"), 0, tol(1e-13));
  EXPECT_NEAR(read(reaction, "bob_mz"), 0, tol(1e-13));
}

// The bob's point slides along the bob as the pin turns. Tension pulls the bob where the point is;
// what it does through the sliding is a torque across the pin, which the joint transmits like a
// motor's.
TEST(JointReactions, HoldTheWorkOfAMovingPathPoint) {
  constexpr double kSlide = 0.05;  // of the point along x per angle [m]
  ModelSpec spec = makeDrivenPendulum();
  PathPointSpec& point = spec.muscles[0].path[1];
  point.kind = PathPointSpec::Kind::kMoving;
  point.coordinate = "angle";
  point.location_functions[0] = {FunctionSpec::Kind::kLinear, {}, {kSlide, 0}, 1};
  point.location_functions[1] = {FunctionSpec::Kind::kConstant, {}, {-kLength}, 1};
  const double q = 0.7;
  const double tension = 100;
  const TimeSeries reaction = calcReaction({q, 0, 0, tension}, spec);
  const Eigen::Rotation2Dd turn(q);
  const Eigen::Vector2d pull =
      (Eigen::Vector2d(0, 0.1) - turn * Eigen::Vector2d(kSlide * q, -kLength)).normalized();
  const double torque = tension * (turn * Eigen::Vector2d(kSlide, 0)).dot(pull);
  EXPECT_GT(std::abs(torque), 0.1);
  EXPECT_NEAR(read(reaction, "bob_mz"), torque, tol(1e-12));
}

TEST(JointReactions, ColumnsAreNamedAfterJointBodyAndFrame) {
  const TimeSeries reaction = calcReaction({});
  ASSERT_EQ(reaction.columnCount(), 18);
  EXPECT_EQ(reaction.labels[0], "pin_on_bob_in_bob_fx");
  EXPECT_EQ(reaction.units[0], "N");
  EXPECT_EQ(reaction.labels[14], "pin_on_bob_in_ground_mz");
  EXPECT_EQ(reaction.units[14], "N.m");
  EXPECT_EQ(reaction.labels[17], "pin_on_bob_in_ground_pz");
  EXPECT_EQ(reaction.units[17], "m");
}

}  // namespace
}  // namespace gaitmill

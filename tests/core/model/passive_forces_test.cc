#include "core/model/passive_forces.h"

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/model/model.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/simple_models.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using Kind = PassiveForceSpec::Kind;

ModelSpec makeWeightlessSlider(const PassiveForceSpec& force) {
  ModelSpec spec = makeSlider("cart");
  spec.gravity.setZero();
  spec.passive_forces = {force};
  return spec;
}

/// Acceleration of a model with one coordinate on which nothing else acts.
double calcAcceleration(ModelState& state, double q, double u) {
  state.setMotion(VectorXd::Constant(1, q), VectorXd::Constant(1, u));
  Eigen::MatrixXd mass(1, 1);
  state.calcMassMatrix(mass);
  VectorXd bias(1);
  state.calcInverseDynamics(VectorXd::Zero(1), {}, bias);
  return -bias[0] / mass(0, 0);
}

struct Motion {
  double q = 0;
  double u = 0;
};

/// Classical Runge-Kutta steps.
Motion integrate(ModelState& state, Motion m, double time, int steps) {
  const double h = time / steps;
  for (int i = 0; i < steps; ++i) {
    const double a1 = calcAcceleration(state, m.q, m.u);
    const double u2 = m.u + 0.5 * h * a1, q2 = m.q + 0.5 * h * m.u;
    const double a2 = calcAcceleration(state, q2, u2);
    const double u3 = m.u + 0.5 * h * a2, q3 = m.q + 0.5 * h * u2;
    const double a3 = calcAcceleration(state, q3, u3);
    const double u4 = m.u + h * a3, q4 = m.q + h * u3;
    const double a4 = calcAcceleration(state, q4, u4);
    m.q += h / 6 * (m.u + 2 * u2 + 2 * u3 + u4);
    m.u += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  return m;
}

// m = 1 kg, k = 40 N/m, c = 0.8 N s/m: q = e^{-t c/2} (cos w t + c/(2w) sin w t) q0.
double calcDampedOscillation(double q0, double t) {
  const double k = 40, c = 0.8;
  const double w = std::sqrt(k - c * c / 4);
  return q0 * std::exp(-c * t / 2) * (std::cos(w * t) + c / (2 * w) * std::sin(w * t));
}

TEST(PassiveForces, ASpringAndADamperMakeADampedOscillator) {
  PassiveForceSpec spring;
  spring.name = "spring";
  spring.kind = Kind::kCoordinateSpring;
  spring.coordinate = "x";
  spring.stiffness = 40;
  spring.viscosity = 0.8;
  spring.rest_length = 0.1;
  const Model model(makeWeightlessSlider(spring));
  ModelState state(model);
  const Motion end = integrate(state, {0.15, 0}, 1.3, 2000);
  EXPECT_NEAR(end.q - 0.1, calcDampedOscillation(0.05, 1.3), tol(1e-12));
}

TEST(PassiveForces, AnExpressionMakesTheSameOscillator) {
  PassiveForceSpec force;
  force.name = "formula";
  force.kind = Kind::kCoordinateExpression;
  force.coordinate = "x";
  force.expressions[0] = "-k*q - 0.8*qdot; k = 40";
  const Model model(makeWeightlessSlider(force));
  ModelState state(model);
  const Motion end = integrate(state, {0.05, 0}, 1.3, 2000);
  EXPECT_NEAR(end.q, calcDampedOscillation(0.05, 1.3), tol(1e-12));
}

PassiveForceSpec makeLimit() {
  PassiveForceSpec limit;
  limit.name = "limit";
  limit.coordinate = "x";
  limit.upper_limit = 0.2;
  limit.lower_limit = -0.3;
  limit.upper_stiffness = 100;
  limit.lower_stiffness = 50;
  limit.damping = 2;
  limit.transition = 0.05;
  return limit;
}

TEST(PassiveForces, ALimitIsASpringBeyondItsTransitionAndNothingWithin) {
  const Model model(makeWeightlessSlider(makeLimit()));
  ModelState state(model);
  EXPECT_EQ(calcAcceleration(state, 0.1, 3), 0);
  EXPECT_EQ(calcAcceleration(state, 0.2, 3), 0);
  EXPECT_NEAR(calcAcceleration(state, 0.3, 0), -100 * 0.1, tol(1e-12));
  EXPECT_NEAR(calcAcceleration(state, 0.3, 3), -100 * 0.1 - 2 * 3, tol(1e-12));
  EXPECT_NEAR(calcAcceleration(state, -0.4, 0), 50 * 0.1, tol(1e-12));
  // Half way through the transition half the stiffness and half the damping act.
  EXPECT_NEAR(calcAcceleration(state, 0.225, 1), -50 * 0.025 - 1, tol(1e-12));
}

// The undamped spring gives back what it took: energy by the integral of the onset.
TEST(PassiveForces, AnUndampedLimitKeepsTheEnergy) {
  PassiveForceSpec limit = makeLimit();
  limit.damping = 0;
  const Model model(makeWeightlessSlider(limit));
  ModelState state(model);
  const Motion back = integrate(state, {0.1, 1}, 0.6, 20000);
  EXPECT_NEAR(std::abs(back.u), 1, tol(1e-9));
  EXPECT_LT(back.u, 0);
}

// Two bodies on gimbals with a bushing between them off their origins.
ModelSpec makeTwoBodies(const PassiveForceSpec& bushing) {
  ModelSpec spec;
  spec.gravity.setZero();
  spec.bodies = {{"a", 1.0, {0.01, 0.02, 0}, {0.1, 0.2, 0.25, 0, 0, 0}, {}},
                 {"b", 2.0, {0, 0.1, 0}, {0.2, 0.1, 0.2, 0, 0, 0}, {}}};
  const auto addJoint = [&](const std::string& name, const std::string& parent) {
    JointSpec joint;
    joint.name = name;
    joint.kind = JointSpec::Kind::kCustom;
    joint.parent = {parent, {0.1, 0.2, 0.3}, {0.1, 0, 0}};
    joint.child = {name, {0, -0.1, 0}, {0, 0, 0.2}};
    for (std::size_t i = 0; i < 6; ++i) {
      joint.coordinates.push_back({name + std::to_string(i)});
      joint.axes[i] = {name + std::to_string(i),
                       Vector3d::Unit(static_cast<Eigen::Index>(i % 3)),
                       {FunctionSpec::Kind::kLinear, {}, {1, 0}, 1}};
    }
    spec.joints.push_back(joint);
  };
  addJoint("a", "ground");
  addJoint("b", "a");
  spec.passive_forces = {bushing};
  return spec;
}

PassiveForceSpec makeBushing() {
  PassiveForceSpec bushing;
  bushing.name = "bushing";
  bushing.kind = Kind::kBushing;
  bushing.frame1 = {"a", {0.05, 0.1, 0}, {0.1, 0.2, 0.3}};
  bushing.frame2 = {"b", {0, -0.1, 0.02}, {0, -0.1, 0.2}};
  bushing.rotational_stiffness = {10, 20, 30};
  bushing.translational_stiffness = {1000, 2000, 3000};
  return bushing;
}

VectorXd makeRandom(std::mt19937& generator, int count, double size) {
  std::uniform_real_distribution<double> unit(-size, size);
  VectorXd values(count);
  for (int i = 0; i < count; ++i) {
    values[i] = unit(generator);
  }
  return values;
}

/// Energy of the springs of a linear bushing, from the poses alone.
double calcBushingEnergy(const ModelState& state, const PassiveForceSpec& bushing) {
  const auto place = [&](const FrameSpec& frame) {
    const Pose& X = state.pose(state.model().getBody(frame.body));
    const Eigen::Matrix3d R = (Eigen::AngleAxisd(frame.orientation.x(), Vector3d::UnitX()) *
                               Eigen::AngleAxisd(frame.orientation.y(), Vector3d::UnitY()) *
                               Eigen::AngleAxisd(frame.orientation.z(), Vector3d::UnitZ()))
                                  .toRotationMatrix();
    return Pose{X.R * R, X * frame.translation};
  };
  const Pose F = place(bushing.frame1), M = place(bushing.frame2);
  const Eigen::Matrix3d R = F.R.transpose() * M.R;
  const Vector3d angles(
      std::atan2(-R(1, 2), R(2, 2)), std::asin(R(0, 2)), std::atan2(-R(0, 1), R(0, 0)));
  const Vector3d shift = F.R.transpose() * (M.p - F.p);
  return 0.5 * (bushing.rotational_stiffness.dot(angles.cwiseAbs2()) +
                bushing.translational_stiffness.dot(shift.cwiseAbs2()));
}

TEST(PassiveForces, ABushingPullsDownItsEnergy) {
  const PassiveForceSpec bushing = makeBushing();
  const Model model(makeTwoBodies(bushing));
  ModelState state(model);
  std::mt19937 generator(3);
  for (int trial = 0; trial < 10; ++trial) {
    const VectorXd q = makeRandom(generator, model.coordinateCount(), 0.4);
    const VectorXd still = VectorXd::Zero(model.coordinateCount());
    VectorXd tau(model.coordinateCount());
    state.setMotion(q, still);
    state.calcInverseDynamics(still, {}, tau);
    for (int c = 0; c < model.coordinateCount(); ++c) {
      constexpr double h = 1e-5;
      const auto energyAt = [&](double step) {
        VectorXd moved = q;
        moved[c] += step;
        state.setPose(moved);
        return calcBushingEnergy(state, bushing);
      };
      const double slope = (energyAt(h) - energyAt(-h)) / (2 * h);
      EXPECT_NEAR(tau[c], slope, tol(2e-6)) << c;  // of some hundred N
    }
  }
}

TEST(PassiveForces, FunctionsAndExpressionsThatAreLinearAreTheLinearBushing) {
  const PassiveForceSpec linear = makeBushing();
  PassiveForceSpec functions = linear;
  functions.kind = Kind::kFunctionBushing;
  PassiveForceSpec expressions = linear;
  expressions.kind = Kind::kExpressionBushing;
  const std::array<std::string, 6> names = {
      "theta_x", "theta_y", "theta_z", "delta_x", "delta_y", "delta_z"};
  for (std::size_t i = 0; i < 6; ++i) {
    const auto k = static_cast<Eigen::Index>(i % 3);
    const double stiffness =
        i < 3 ? linear.rotational_stiffness[k] : linear.translational_stiffness[k];
    functions.functions[i] = {FunctionSpec::Kind::kLinear, {}, {stiffness, 0}, 1};
    expressions.expressions[i] = std::to_string(stiffness) + "*" + names[i];
  }
  std::mt19937 generator(5);
  std::vector<VectorXd> taus;
  const VectorXd q = makeRandom(generator, 12, 0.4);
  const VectorXd u = makeRandom(generator, 12, 1.0);
  for (PassiveForceSpec force : {linear, functions, expressions}) {
    force.rotational_damping = {0.1, 0.2, 0.3};
    force.translational_damping = {1, 2, 3};
    const Model model(makeTwoBodies(force));
    ModelState state(model);
    state.setMotion(q, u);
    taus.emplace_back(12);
    state.calcInverseDynamics(VectorXd::Zero(12), {}, taus.back());
  }
  EXPECT_LT((taus[1] - taus[0]).norm(), tol(1e-11));
  EXPECT_LT((taus[2] - taus[0]).norm(), tol(1e-11));
}

// Power is the work done on the bodies: minus the rate of the spring energy, less the damping.
TEST(PassiveForces, PowerIsTheLossOfEnergy) {
  PassiveForceSpec bushing = makeBushing();
  const Model model(makeTwoBodies(bushing));
  ModelState state(model);
  std::mt19937 generator(9);
  const VectorXd q = makeRandom(generator, 12, 0.4);
  const VectorXd u = makeRandom(generator, 12, 1.0);
  constexpr double h = 1e-6;
  const auto energyAt = [&](double t) {
    state.setPose(q + t * u);
    return calcBushingEnergy(state, bushing);
  };
  const double rate = (energyAt(h) - energyAt(-h)) / (2 * h);
  state.setMotion(q, u);
  EXPECT_NEAR(state.calcPassivePower(), -rate, tol(1e-6));
  bushing.translational_damping = {5, 5, 5};
  bushing.rotational_damping = {1, 1, 1};
  const Model damped(makeTwoBodies(bushing));
  ModelState damped_state(damped);
  damped_state.setMotion(q, u);
  EXPECT_LT(damped_state.calcPassivePower(), state.calcPassivePower());
}

// What the joints transmit holds the bushing's pull: joint wrenches and inverse dynamics agree.
TEST(PassiveForces, JointWrenchesHoldThem) {
  PassiveForceSpec bushing = makeBushing();
  bushing.translational_damping = {5, 5, 5};
  const Model model(makeTwoBodies(bushing));
  ModelState state(model);
  std::mt19937 generator(13);
  const VectorXd u_dot = makeRandom(generator, 12, 2.0);
  state.setMotion(makeRandom(generator, 12, 0.4), makeRandom(generator, 12, 1.0));
  VectorXd tau(12);
  state.calcInverseDynamics(u_dot, {}, tau);
  Matrix6X wrenches;
  state.calcJointWrenches(u_dot, {}, wrenches);
  for (int c = 0; c < 12; ++c) {
    EXPECT_NEAR(state.screws().col(c).dot(wrenches.col(c / 6)), tau[c], tol(1e-10)) << c;
  }
}

TEST(PassiveForces, UnknownNamesAndBadFormulasAreRefused) {
  PassiveForceSpec force = makeLimit();
  force.coordinate = "y";
  EXPECT_THROW(Model{makeWeightlessSlider(force)}, Error);
  force = makeLimit();
  force.kind = Kind::kCoordinateExpression;
  force.expressions[0] = "q*";
  EXPECT_THROW(Model{makeWeightlessSlider(force)}, Error);
  force = makeBushing();
  force.frame2.body = "nobody";
  EXPECT_THROW(Model{makeWeightlessSlider(force)}, Error);
}

}  // namespace
}  // namespace gaitmill

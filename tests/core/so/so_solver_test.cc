#include "core/so/so_solver.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/math/ipopt_qp.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/model_files.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

ActuatorSpec makeActuator(const std::string& name, const std::string& coordinate, double force) {
  ActuatorSpec actuator;
  actuator.name = name;
  actuator.coordinate = coordinate;
  actuator.optimal_force = force;
  return actuator;
}

/// Point mass m on a massless-looking rod l, hinge about z; q = 0 hangs down.
ModelSpec makePendulum() {
  ModelSpec spec;
  BodySpec rod;
  rod.name = "rod";
  rod.mass = 2;
  rod.mass_center = {0, -0.4, 0};
  rod.inertia = {1e-6, 1e-6, 1e-6, 0, 0, 0};
  spec.bodies.push_back(rod);
  JointSpec joint;
  joint.name = "hinge";
  joint.kind = JointSpec::Kind::kPin;
  joint.parent.body = "ground";
  joint.child.body = "rod";
  joint.coordinates.emplace_back();
  joint.coordinates.back().name = "angle";
  spec.joints.push_back(joint);
  return spec;
}

struct Motion {
  Eigen::VectorXd q, u, u_dot;
};

Motion makeStill(int n) {
  return {Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
}

SoSolver::Instant at(const Motion& motion) {
  return {0.0, motion.q, motion.u, motion.u_dot};
}

// tau = m l^2 udot + m g l sin q, shared by two motors in proportion to their strength (p = 2).
TEST(SoSolver, TwoMotorsShareAPendulumByTheirStrength) {
  const Model model(makePendulum());
  SoOptions options;
  options.actuators = {makeActuator("weak", "angle", 1), makeActuator("strong", "angle", 3)};
  SoSolver solver(model, options);
  Motion motion = makeStill(1);
  motion.q << 0.7;
  motion.u_dot << 3;
  Eigen::VectorXd a(2);
  solver.solveInstant(at(motion), ExternalLoads(model, {}), a);
  const double tau = (2 * 0.16 + 1e-6) * 3 + 2 * kGravity * 0.4 * std::sin(0.7);
  EXPECT_NEAR(solver.demand()[0], tau, tol(1e-12));
  EXPECT_NEAR(a[0], tau * 1 / 10, tol(1e-9));
  EXPECT_NEAR(a[1], tau * 3 / 10, tol(1e-9));
}

TEST(SoSolver, InfeasibleRowIsReportedNotThrown) {
  const Model model(makePendulum());
  SoOptions options;
  options.actuators = {makeActuator("motor", "angle", 1)};
  options.actuators[0].min_control = -1;
  options.actuators[0].max_control = 1;
  std::vector<double> time;
  for (int i = 0; i < 20; ++i) {
    time.push_back(0.01 * i);
  }
  TimeSeries still = makeTimeSeries("coordinates", {"angle"}, time);
  still.values.setConstant(0.5);
  const SoResult result = SoSolver(model, options).solve(still, ExternalLoads(model, {}));
  ASSERT_EQ(result.infeasible_rows.size(), 20U);
  EXPECT_EQ(result.infeasible_rows[3].coordinate, "angle");
  EXPECT_NEAR(result.infeasible_rows[3].missing, 2 * kGravity * 0.4 * std::sin(0.5) - 1, tol(1e-6));
  EXPECT_NEAR(result.activations.values(3, 0), 1.0, tol(1e-9));
  EXPECT_EQ(result.warnings.size(), 1U);
}

TEST(SoSolver, RowIntervalAndRangePickRows) {
  const Model model(makePendulum());
  SoOptions options;
  options.actuators = {makeActuator("motor", "angle", 1)};
  options.range = {0.1, 0.3};
  options.row_interval = 5;
  std::vector<double> time;
  for (int i = 0; i <= 40; ++i) {
    time.push_back(0.01 * i);
  }
  TimeSeries still = makeTimeSeries("coordinates", {"angle"}, time);
  still.values.setConstant(0.5);
  const SoResult result = SoSolver(model, options).solve(still, ExternalLoads(model, {}));
  ASSERT_EQ(result.activations.rowCount(), 5);
  EXPECT_NEAR(result.activations.time[1], 0.15, tol(1e-12));
  EXPECT_EQ(result.forces.units[0], "N.m");
  EXPECT_NEAR(result.peak_actuator_forces[0], 2 * kGravity * 0.4 * std::sin(0.5), tol(1e-9));
}

TEST(SoSolver, ExponentBelowOneIsRefused) {
  const Model model(makePendulum());
  SoOptions options;
  options.exponent = 0.5;
  try {
    SoSolver solver(model, options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInputValue);
    EXPECT_EQ(error.where().field, "exponent");
  }
}

/// The project's model in mid-stance, held by residuals and reserves.
class SoOnWalker : public ::testing::Test {
 protected:
  SoOnWalker() {
    for (const CoordinateIndex c : free_.indices()) {
      const bool is_root = c.value() < 6;
      options_.actuators.push_back(makeActuator(
          model_.coordinate(c).name + "_reserve", model_.coordinate(c).name, is_root ? 100 : 5));
    }
    motion_ = makeStill(free_.count());
    free_.pick(model_.defaultPose(), motion_.q);
    const auto set = [&](const char* name, double q, double u, double u_dot) {
      const int f = free_.findFree(model_.getCoordinate(name));
      motion_.q[f] = q;
      motion_.u[f] = u;
      motion_.u_dot[f] = u_dot;
    };
    set("hip_flexion_r", 0.4, -1.0, 4.0);
    set("hip_adduction_r", -0.05, 0.2, 1.0);
    set("knee_angle_r", 0.3, 0.8, -6.0);
    set("ankle_angle_r", 0.1, -0.5, 8.0);
    set("hip_flexion_l", -0.2, 1.0, -3.0);
    set("knee_angle_l", 0.6, 1.5, 5.0);
    set("ankle_angle_l", -0.1, 0.4, -2.0);
    set("hip_rotation_l", 0.1, 0.4, -2.0);
  }

  /// Activations at the instant.
  Eigen::VectorXd solve(SoSolver& solver, const Motion& motion) const {
    Eigen::VectorXd a(solver.actuatorCount());
    solver.solveInstant(at(motion), loads_, a);
    return a;
  }

  Model model_{readOwnModel()};
  FreeCoordinates free_{model_};
  ExternalLoads loads_{model_, {}};
  SoOptions options_;
  Motion motion_;
};

TEST_F(SoOnWalker, ForcesProduceTheDemand) {
  SoSolver solver(model_, options_);
  const Eigen::VectorXd a = solve(solver, motion_);
  EXPECT_NEAR((solver.problem().A * a - solver.demand()).lpNorm<Eigen::Infinity>(), 0, tol(1e-6));
  EXPECT_GE(a.head(80).minCoeff(), 0.01);
  EXPECT_LE(a.head(80).maxCoeff(), 1.0);
}

// A second solver, of another kind, finds no cheaper sharing.
TEST_F(SoOnWalker, CostIsThatOfIpopt) {
  for (const double exponent : {1.5, 2.0, 3.0}) {
    options_.exponent = exponent;
    options_.solver = SoOptions::Solver::kDualNewton;
    SoSolver dual(model_, options_);
    options_.solver = SoOptions::Solver::kIpopt;
    SoSolver interior(model_, options_);
    const auto calcCost = [&](const Eigen::VectorXd& a) {
      return a.cwiseAbs().array().pow(exponent).sum();
    };
    const double cost = calcCost(solve(dual, motion_));
    EXPECT_NEAR(calcCost(solve(interior, motion_)) / cost, 1.0, tol(1e-5)) << exponent;
  }
}

// Each exponent's answer is the cheapest in its own measure.
TEST_F(SoOnWalker, ExponentOneCostsNoMoreThanExponentTwoAndMeetsTheDemand) {
  SoSolver quadratic(model_, options_);
  options_.exponent = 1;
  SoSolver linear(model_, options_);
  const Eigen::VectorXd a1 = solve(linear, motion_);
  const Eigen::VectorXd a2 = solve(quadratic, motion_);
  EXPECT_NEAR(linear.slack().lpNorm<Eigen::Infinity>(), 0, tol(1e-6));
  EXPECT_LE(a1.lpNorm<1>(), a2.lpNorm<1>());
  EXPECT_LE(a2.squaredNorm(), a1.squaredNorm());
}

TEST_F(SoOnWalker, TwiceTheStrengthHalvesTheActivations) {
  ModelSpec weak = model_.spec();
  for (MuscleSpec& muscle : weak.muscles) {
    muscle.min_control = 0;
  }
  for (ActuatorSpec& actuator : weak.actuators) {
    actuator.min_control = -1e300;
    actuator.max_control = 1e300;
  }
  ModelSpec strong = weak;
  SoOptions strong_options = options_;
  for (MuscleSpec& muscle : strong.muscles) {
    muscle.max_isometric_force *= 2;
  }
  for (ActuatorSpec& actuator : strong.actuators) {
    actuator.optimal_force *= 2;
  }
  for (ActuatorSpec& actuator : strong_options.actuators) {
    actuator.optimal_force *= 2;
  }
  const Model weak_model(weak);
  const Model strong_model(strong);
  SoSolver weak_solver(weak_model, options_);
  SoSolver strong_solver(strong_model, strong_options);
  const Eigen::VectorXd a = solve(weak_solver, motion_);
  ASSERT_LT(a.head(80).maxCoeff(), 1.0);  // no muscle is at its limit
  EXPECT_NEAR((solve(strong_solver, motion_) - 0.5 * a).lpNorm<Eigen::Infinity>(), 0, tol(1e-8));
}

TEST_F(SoOnWalker, MirroredMotionHasMirroredActivations) {
  const auto swapSide = [](std::string name) {
    const std::size_t mark = name.rfind("_r");
    const std::size_t other = name.rfind("_l");
    if (mark == name.size() - 2) {
      return name.replace(mark, 2, "_l");
    }
    return other == name.size() - 2 ? name.replace(other, 2, "_r") : name;
  };
  Motion mirrored = motion_;
  for (int f = 0; f < free_.count(); ++f) {
    const std::string& name = model_.coordinate(free_.indices()[static_cast<std::size_t>(f)]).name;
    const int image = free_.findFree(model_.getCoordinate(swapSide(name)));
    mirrored.q[image] = motion_.q[f];
    mirrored.u[image] = motion_.u[f];
    mirrored.u_dot[image] = motion_.u_dot[f];
  }
  SoSolver solver(model_, options_);
  const Eigen::VectorXd a = solve(solver, motion_);
  const Eigen::VectorXd image = solve(solver, mirrored);
  for (int m = 0; m < model_.muscleCount(); ++m) {
    const std::string& name = model_.spec().muscles[static_cast<std::size_t>(m)].name;
    EXPECT_NEAR(a[m], image[model_.spec().findMuscle(swapSide(name))], tol(1e-6)) << name;
  }
}

TEST_F(SoOnWalker, PassiveForceIsPartOfTheBalance) {
  options_.passive_force = SoOptions::PassiveForce::kOn;
  const int f = free_.findFree(model_.getCoordinate("ankle_angle_r"));
  motion_.q[f] = 0.5;  // stretches the calf
  SoSolver solver(model_, options_);
  const Eigen::VectorXd a = solve(solver, motion_);
  EXPECT_GT(solver.passiveForces()[model_.spec().findMuscle("soleus_r")], 10);
  // What the activations must produce is the demand without the passive part.
  EXPECT_GT((solver.problem().c - solver.demand()).cwiseAbs()[f], 1);
  EXPECT_NEAR(
      (solver.problem().A * a - solver.problem().c).lpNorm<Eigen::Infinity>(), 0, tol(1e-6));
}

TEST_F(SoOnWalker, IsometricCapacityIgnoresLengthAndSpeed) {
  options_.capacity = SoOptions::Capacity::kIsometric;
  SoSolver solver(model_, options_);
  solve(solver, motion_);
  for (int m = 0; m < model_.muscleCount(); ++m) {
    EXPECT_EQ(solver.gains()[m],
              model_.spec().muscles[static_cast<std::size_t>(m)].max_isometric_force);
  }
}

// Rows allocate what Simbody's realization of a motion does, and nothing else.
TEST_F(SoOnWalker, InstantAllocatesNothingOfItsOwn) {
  SoSolver solver(model_, options_);
  Eigen::VectorXd a = solve(solver, motion_);
  ModelState state(model_);
  Eigen::VectorXd q = model_.defaultPose();
  const Eigen::VectorXd u = Eigen::VectorXd::Zero(model_.coordinateCount());
  Eigen::VectorXd tau(model_.coordinateCount());
  state.setMotion(q, u);
  const auto realize = [&] {
    state.setMotion(q, u);
    state.calcInverseDynamics(u, {}, tau);
  };
  realize();
  const long of_the_model = countAllocationsOf(realize);
  const long of_the_instant =
      countAllocationsOf([&] { solver.solveInstant(at(motion_), loads_, a); });
  EXPECT_EQ(of_the_instant, of_the_model);
}

}  // namespace
}  // namespace gaitmill

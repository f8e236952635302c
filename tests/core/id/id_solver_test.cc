#include "core/id/id_solver.h"

#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/model_files.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

std::vector<double> makeTimes(int count, double step) {
  std::vector<double> time;
  for (int i = 0; i < count; ++i) time.push_back(i * step);
  return time;
}

// Smooth motion of all coordinates but the knees, which stay flexed. In the knee Simbody's
// function-based joint (and so OpenSim) takes Coriolis forces that are not quite the derivative of
// its velocities: 0.016 W of missing power at 1.2 rad/s, in the reference as well.
TimeSeries makeSmoothMotion(const Model& model, int rows, double step) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0, 1);
  TimeSeries motion = makeTimeSeries("motion", model.coordinateNames(), makeTimes(rows, step));
  for (int c = 0; c < model.coordinateCount(); ++c) {
    const bool knee = motion.labels[static_cast<std::size_t>(c)].rfind("knee_angle", 0) == 0;
    const double middle = 0.1 + 0.2 * uniform(random);
    const double amplitude = knee ? 0 : middle;
    const double frequency = 0.5 + uniform(random);
    const double phase = 2 * kPi * uniform(random);
    for (int i = 0; i < rows; ++i) {
      motion.values(i, c) = model.defaultPose()(c) + middle +
                            amplitude * std::sin(2 * kPi * frequency * i * step + phase);
    }
  }
  return motion;
}

ModelSpec makePendulum(double mass, double length) {
  ModelSpec spec;
  spec.bodies = {{"bob", mass, {0, -length, 0}, {0, 0, 0, 0, 0, 0}, {}}};
  JointSpec pin;
  pin.name = "pin";
  pin.kind = JointSpec::Kind::kPin;
  pin.parent.body = "ground";
  pin.child.body = "bob";
  pin.coordinates = {{"angle"}};
  spec.joints = {pin};
  return spec;
}

// tau = m l^2 q'' + m g l sin q for q = 0.7 sin(3 t).
TEST(IdSolver, SwingingPendulumMatchesClosedForm) {
  const Model model(makePendulum(2.0, 0.4));
  TimeSeries motion = makeTimeSeries("swing", {"angle"}, makeTimes(400, 0.005));
  for (int i = 0; i < 400; ++i) {
    motion.values(i, 0) = 0.7 * std::sin(3 * motion.time[static_cast<std::size_t>(i)]);
  }
  const IdResult result = IdSolver(model, {}).solve(motion, nullptr);
  const int column = result.generalized_forces.getColumn("angle_moment");
  for (int i = 40; i < 360; ++i) {
    const double q = motion.values(i, 0);
    const double expected = 2.0 * 0.4 * 0.4 * (-9 * q) + 2.0 * kGravity * 0.4 * std::sin(q);
    EXPECT_NEAR(result.generalized_forces.values(i, column), expected, tol(1e-8));
  }
  EXPECT_EQ(result.residual_wrench.columnCount(), 0);
}

// One foot carries the weight under the mass center: nothing is left to explain. Without the ground
// the whole weight is missing, upward.
TEST(IdSolver, QuietStandingNeedsExactlyTheWeight) {
  const Model model(readOwnModel());
  ModelState state(model);
  state.setPose(model.defaultPose());
  const Eigen::Vector3d center = state.calcMassCenter();
  const double weight = model.spec().calcTotalMass() * kGravity;
  TimeSeries still = makeTimeSeries("still", model.coordinateNames(), makeTimes(20, 0.01));
  still.values.rowwise() = model.defaultPose().transpose();

  GroundReaction reaction;
  reaction.time = still.time;
  ExternalForce foot{"right", "calcn_r", {}, {}, {}};
  foot.force = Eigen::Vector3d(0, weight, 0).replicate(1, 20);
  foot.point = Eigen::Vector3d(center.x(), 0, center.z()).replicate(1, 20);
  foot.torque = Eigen::Matrix3Xd::Zero(3, 20);
  reaction.forces = {foot};
  const ExternalLoads loads(model, reaction);

  IdSolver solver(model, {});
  const IdResult standing = solver.solve(still, &loads);
  EXPECT_LE(standing.residual_wrench.values.cwiseAbs().maxCoeff(), tol(1e-7));
  const int pelvis_ty = standing.generalized_forces.getColumn("pelvis_ty_force");
  EXPECT_NEAR(standing.generalized_forces.values(10, pelvis_ty), 0, tol(1e-7));

  const IdResult hanging = solver.solve(still, nullptr);
  EXPECT_NEAR(hanging.generalized_forces.values(10, pelvis_ty), weight, tol(1e-7));
  EXPECT_NEAR(hanging.residual_wrench.values(10, 1), weight, tol(1e-7));
  EXPECT_NEAR(hanging.residual_wrench.values.row(10).tail<3>().norm(), 0, tol(1e-7));
}

// sum tau u = d (kinetic + potential energy) / dt when nothing else acts.
TEST(IdSolver, PowerOfTheForcesIsTheChangeOfEnergy) {
  const Model model(readOwnModel());
  const int rows = 400;
  const double step = 0.005;
  const TimeSeries motion = makeSmoothMotion(model, rows, step);
  const IdResult result = IdSolver(model, {}).solve(motion, nullptr);
  ModelState state(model);
  RowMatrix energy(rows, 1);
  for (int i = 0; i < rows; ++i) {
    state.setMotion(result.coordinates.values.row(i).transpose(),
                    result.speeds.values.row(i).transpose());
    energy(i, 0) = state.calcKineticEnergy() + state.calcPotentialEnergy();
  }
  const NaturalSpline spline(motion.time, energy, 5);
  Eigen::VectorXd value(1), rate(1), second(1);
  double largest = 0;
  double worst = 0;
  for (int i = 40; i < rows - 40; ++i) {
    spline.evaluate(motion.time[static_cast<std::size_t>(i)], value, rate, second);
    const double power = result.generalized_forces.values.row(i)
                             .head(model.coordinateCount())
                             .dot(result.speeds.values.row(i));
    largest = std::max(largest, std::abs(power));
    worst = std::max(worst, std::abs(power - rate(0)));
  }
  EXPECT_LE(worst / largest, tol(1e-8));
}

// Total force = d (momentum) / dt: the residual force is mass times the mass center's acceleration
// plus weight.
TEST(IdSolver, ResidualForceIsWhatTheMassCenterNeeds) {
  const Model model(readOwnModel());
  const TimeSeries motion = makeSmoothMotion(model, 300, 0.005);
  const IdResult result = IdSolver(model, {}).solve(motion, nullptr);
  ModelState state(model);
  RowMatrix center(300, 3);
  for (int i = 0; i < 300; ++i) {
    state.setPose(result.coordinates.values.row(i).transpose());
    center.row(i) = state.calcMassCenter().transpose();
  }
  const NaturalSpline spline(motion.time, center, 5);
  Eigen::VectorXd p(3), v(3), a(3);
  const double mass = model.spec().calcTotalMass();
  for (int i = 60; i < 240; i += 20) {
    spline.evaluate(motion.time[static_cast<std::size_t>(i)], p, v, a);
    const Eigen::Vector3d expected = mass * (a + Eigen::Vector3d(0, kGravity, 0));
    const Eigen::Vector3d force = result.residual_wrench.values.row(i).head<3>().transpose();
    EXPECT_LE((force - expected).norm(), tol(1e-7) * mass * kGravity);
  }
}

TEST(IdSolver, KneeSumAddsThePatellaToTheKnee) {
  const Model model(readOwnModel());
  const IdResult result = IdSolver(model, {}).solve(makeSmoothMotion(model, 50, 0.01), nullptr);
  const TimeSeries& forces = result.generalized_forces;
  const auto knee = forces.values.col(forces.getColumn("knee_angle_r_moment"));
  const auto patella = forces.values.col(forces.getColumn("knee_angle_r_beta_force"));
  const auto sum =
      forces.values.col(forces.getColumn("knee_angle_r_moment_with_knee_angle_r_beta"));
  EXPECT_LE((knee + patella - sum).cwiseAbs().maxCoeff(), tol(1e-12));
  EXPECT_GT(patella.cwiseAbs().maxCoeff(), 0);
}

TEST(IdSolver, ReportsRowsFromTheLastBeforeTheStart) {
  const Model model(makePendulum(1, 1));
  TimeSeries motion = makeTimeSeries("swing", {"angle"}, makeTimes(100, 0.01));
  motion.values.setZero();
  IdOptions options;
  options.start_time = 0.205;
  options.end_time = 0.305;
  const IdResult result = IdSolver(model, options).solve(motion, nullptr);
  EXPECT_NEAR(result.generalized_forces.time.front(), 0.20, tol(1e-12));
  EXPECT_NEAR(result.generalized_forces.time.back(), 0.30, tol(1e-12));
}

TEST(IdSolver, FilteredMotionStaysInsideTheRecord) {
  const Model model(makePendulum(1, 1));
  TimeSeries motion = makeTimeSeries("swing", {"angle"}, makeTimes(100, 0.01));
  motion.values.setConstant(0.3);
  IdOptions options;
  options.lowpass_cutoff = 6;
  const IdResult result = IdSolver(model, options).solve(motion, nullptr);
  EXPECT_GE(result.generalized_forces.time.front(), -1e-9);
  EXPECT_LE(result.generalized_forces.time.back(), 0.99 + 1e-9);
  EXPECT_EQ(result.lowpass_cutoff, 6);
  EXPECT_NEAR(result.generalized_forces.values(50, 0), kGravity * std::sin(0.3), tol(1e-9));
}

TEST(IdSolver, RefusesATableWithoutCoordinates) {
  const Model model(makePendulum(1, 1));
  TimeSeries motion = makeTimeSeries("swing", {"angel"}, makeTimes(100, 0.01));
  motion.values.setZero();
  try {
    IdSolver(model, {}).solve(motion, nullptr);
    FAIL() << "did not throw";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInputCoordinates);
  }
}

}  // namespace
}  // namespace gaitmill

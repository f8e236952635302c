#include "core/id/id_solver.h"

#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/model_files.h"
#include "tests/support/simple_models.h"
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

// Ground reaction of some size under both feet, varying over time.
GroundReaction makeReaction(const std::vector<double>& time) {
  GroundReaction reaction;
  reaction.time = time;
  const auto n = static_cast<Eigen::Index>(time.size());
  for (const char* body : {"calcn_r", "calcn_l"}) {
    ExternalForce foot{body, body, {}, {}, {}};
    foot.force.resize(3, n);
    foot.point.resize(3, n);
    foot.torque = Eigen::Matrix3Xd::Zero(3, n);
    const double side = body == std::string("calcn_r") ? 1 : -1;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double t = time[static_cast<std::size_t>(i)];
      foot.force.col(i) << 50 * std::sin(5 * t + side), 400 + 200 * side * std::cos(4 * t), 30 * t;
      foot.point.col(i) << 0.1 * t, 0, 0.1 * side;
      foot.torque(1, i) = 3 * std::sin(6 * t);
    }
    reaction.forces.push_back(foot);
  }
  return reaction;
}

// Largest difference of all joint moments (not of the pelvis), relative to the largest moment.
double compareJointMoments(const Model& model, const RowMatrix& a, const RowMatrix& b) {
  const Eigen::Index joints = model.coordinateCount() - 6;
  return (a - b).middleCols(6, joints).cwiseAbs().maxCoeff() /
         a.middleCols(6, joints).cwiseAbs().maxCoeff();
}

TEST(IdSolver, TurningTheLaboratoryLeavesJointMomentsAlone) {
  const Model model(readOwnModel());
  const TimeSeries motion = makeSmoothMotion(model, 100, 0.01);
  const GroundReaction reaction = makeReaction(motion.time);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY()).toRotationMatrix();

  // Pelvis: tilt about z, list about x, rotation about y, in this order; then the translations.
  TimeSeries turned = motion;
  for (int i = 0; i < motion.rowCount(); ++i) {
    const Eigen::Matrix3d R = turn *
                              Eigen::AngleAxisd(motion.values(i, 0), Eigen::Vector3d::UnitZ()) *
                              Eigen::AngleAxisd(motion.values(i, 1), Eigen::Vector3d::UnitX()) *
                              Eigen::AngleAxisd(motion.values(i, 2), Eigen::Vector3d::UnitY());
    turned.values(i, 0) = std::atan2(-R(0, 1), R(1, 1));
    turned.values(i, 1) = std::asin(R(2, 1));
    turned.values(i, 2) = std::atan2(-R(2, 0), R(2, 2));
    const Eigen::Vector3d p = motion.values.row(i).segment<3>(3).transpose();
    turned.values.row(i).segment<3>(3) = (turn * p).transpose();
  }
  GroundReaction turned_reaction = reaction;
  for (ExternalForce& force : turned_reaction.forces) {
    force.force = turn * force.force;
    force.point = turn * force.point;
    force.torque = turn * force.torque;
  }

  const ExternalLoads loads(model, reaction);
  const ExternalLoads turned_loads(model, turned_reaction);
  IdSolver solver(model, {});
  const RowMatrix before = solver.solve(motion, &loads).generalized_forces.values;
  const RowMatrix after = solver.solve(turned, &turned_loads).generalized_forces.values;
  // The turned pelvis angles are other curves: their splines differ by the spline's own error.
  EXPECT_LE(compareJointMoments(model, before.middleRows(20, 60), after.middleRows(20, 60)),
            tol(1e-6));
}

// "hip_flexion_r" -> "hip_flexion_l", "knee_angle_l_beta" -> "knee_angle_r_beta", others as they
// are.
std::string swapSide(std::string name) {
  for (std::size_t at = name.find('_'); at != std::string::npos; at = name.find('_', at + 1)) {
    if (at + 2 != name.size() && (at + 2 > name.size() || name[at + 2] != '_')) continue;
    if (name[at + 1] == 'r' || name[at + 1] == 'l') name[at + 1] = name[at + 1] == 'r' ? 'l' : 'r';
  }
  return name;
}

// Mirrored at the sagittal plane: sides swap; list, rotation, sideways and the trunk's like change
// sign.
TEST(IdSolver, MirroredMotionHasMirroredMoments) {
  const Model model(readOwnModel());
  const TimeSeries motion = makeSmoothMotion(model, 60, 0.01);
  const GroundReaction reaction = makeReaction(motion.time);
  std::vector<int> partner;
  Eigen::RowVectorXd sign = Eigen::RowVectorXd::Ones(model.coordinateCount());
  for (int c = 0; c < model.coordinateCount(); ++c) {
    std::string name = motion.labels[static_cast<std::size_t>(c)];
    for (const char* odd :
         {"pelvis_list", "pelvis_rotation", "pelvis_tz", "lumbar_bending", "lumbar_rotation"}) {
      if (name == odd) sign(c) = -1;
    }
    partner.push_back(motion.getColumn(swapSide(name)));
  }
  const auto mirror = [&](const RowMatrix& values) {
    RowMatrix mirrored(values.rows(), model.coordinateCount());
    for (int c = 0; c < model.coordinateCount(); ++c) {
      mirrored.col(c) = sign(c) * values.col(partner[static_cast<std::size_t>(c)]);
    }
    return mirrored;
  };
  TimeSeries mirrored = motion;
  mirrored.values = mirror(motion.values);
  GroundReaction mirrored_reaction = reaction;
  for (ExternalForce& force : mirrored_reaction.forces) {
    force.body = force.body == "calcn_r" ? "calcn_l" : "calcn_r";
    force.force.row(2) *= -1;
    force.point.row(2) *= -1;
    force.torque.topRows(2) *= -1;
  }
  const ExternalLoads loads(model, reaction);
  const ExternalLoads mirrored_loads(model, mirrored_reaction);
  IdSolver solver(model, {});
  const RowMatrix expected = mirror(solver.solve(motion, &loads).generalized_forces.values);
  const RowMatrix found = solver.solve(mirrored, &mirrored_loads)
                              .generalized_forces.values.leftCols(model.coordinateCount());
  EXPECT_LE(compareJointMoments(model, expected, found), tol(1e-6));
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

#include "core/rra/rra_solver.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/model/model.h"
#include "tests/support/model_files.h"
#include "tests/support/paper_rra.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

// A person standing still on one foot for three seconds; the plate says `true_mass`, its center of
// pressure lies `ahead` and `right` of the mass center that the model has.
struct Standing {
  ModelSpec spec = readOwnModel();
  TimeSeries coordinates;
  GroundReaction reaction;

  Standing(double true_mass, double ahead, double right) {
    const Model model(spec);
    ModelState state(model);
    state.setPose(model.defaultPose());
    const Eigen::Vector3d center = state.calcMassCenter();
    std::vector<double> time;
    for (int i = 0; i <= 300; ++i) time.push_back(0.01 * i);
    coordinates = makeTimeSeries("still", model.coordinateNames(), time);
    coordinates.values.rowwise() = model.defaultPose().transpose();
    reaction.time = time;
    ExternalForce foot{"right", "calcn_r", {}, {}, {}};
    foot.force = Eigen::Vector3d(0, true_mass * kGravity, 0).replicate(1, 301);
    foot.point = Eigen::Vector3d(center.x() + ahead, 0, center.z() + right).replicate(1, 301);
    foot.torque = Eigen::Matrix3Xd::Zero(3, 301);
    reaction.forces = {foot};
  }

  RraResult solve(RraOptions options) const {
    options.passes.resize(1);
    options.passes[0].start_time = 1.0;
    options.passes[0].end_time = 1.1;
    return solveRra(spec, coordinates, reaction, options);
  }
};

TEST(RraSolver, FindsTheMassThatThePlateMeasured) {
  const double model_mass = readOwnModel().calcTotalMass();
  const RraResult result = Standing(model_mass + 1.5, 0, 0).solve(makePaperWalkRra());
  const MassAdjustment& adjustment = result.passes[0].adjustment;
  EXPECT_NEAR(adjustment.mass_change, 1.5, tol(1e-8));
  EXPECT_NEAR(result.passes[0].adjusted_model.calcTotalMass(), model_mass + 1.5, tol(1e-8));
}

// The torso stands upright, so the shift is exact: afterwards no average moment is left.
TEST(RraSolver, ShiftsTheMassCenterOverTheCenterOfPressure) {
  const ModelSpec spec = readOwnModel();
  const double mass = spec.calcTotalMass();
  const Standing standing(mass, 0.01, -0.005);
  RraOptions options = makePaperWalkRra();
  // At the mass center's own height and place the residual force has no lever.
  const RraResult result = standing.solve(options);
  const MassAdjustment& adjustment = result.passes[0].adjustment;
  const double torso = spec.bodies[static_cast<std::size_t>(spec.findBody("torso"))].mass;
  EXPECT_NEAR(adjustment.shift_x, -0.01 * mass / torso, tol(1e-8));
  EXPECT_NEAR(adjustment.shift_z, 0.005 * mass / torso, tol(1e-8));
  EXPECT_NEAR(adjustment.average_after.moment.x(), 0, tol(1e-6));
  EXPECT_NEAR(adjustment.average_after.moment.z(), 0, tol(1e-6));
  EXPECT_FALSE(adjustment.shift_limited);
}

TEST(RraSolver, LimitsTheShift) {
  const double mass = readOwnModel().calcTotalMass();
  const RraResult result = Standing(mass, 0.2, 0).solve(makePaperWalkRra());
  EXPECT_TRUE(result.passes[0].adjustment.shift_limited);
  EXPECT_EQ(result.passes[0].adjustment.shift_x, -0.1);
}

TEST(RraSolver, FollowsAConsistentMotionExactly) {
  const double mass = readOwnModel().calcTotalMass();
  const RraResult result = Standing(mass, 0, 0).solve(makePaperWalkRra());
  EXPECT_LE(result.passes[0].tracking.max_deg, tol(1e-2));
  EXPECT_LE(result.passes[0].residuals.peak.force.maxCoeff(), tol(1e-1));
}

TEST(RraSolver, RepeatsTheLastPassUntilTheChangesAreSmall) {
  const double mass = readOwnModel().calcTotalMass();
  RraOptions options = makePaperWalkRra();
  options.max_passes = 6;
  options.mass_tolerance = 1e-3;
  options.mass_center_tolerance = 1e-4;
  const RraResult result = Standing(mass + 1.5, 0.01, 0).solve(options);
  EXPECT_TRUE(result.converged);
  EXPECT_GE(result.passes.size(), 2u);
  EXPECT_LT(result.passes.size(), 6u);
  EXPECT_LT(std::abs(result.passes.back().adjustment.mass_change), 1e-3);
}

TEST(RraSolver, KeepsOrScalesInertiasWithTheMass) {
  const double mass = readOwnModel().calcTotalMass();
  const Standing standing(1.02 * mass, 0, 0);
  RraOptions options = makePaperWalkRra();
  const BodySpec before = standing.spec.bodies[0];
  EXPECT_EQ(standing.solve(options).passes[0].adjusted_model.bodies[0].inertia, before.inertia);
  options.inertia_scaling = InertiaScaling::kWithMass;
  const BodySpec after = standing.solve(options).passes[0].adjusted_model.bodies[0];
  EXPECT_NEAR(after.inertia[0] / before.inertia[0], 1.02, tol(1e-9));
}

TEST(RraSolver, StopsWhenAskedTo) {
  const Standing standing(readOwnModel().calcTotalMass(), 0, 0);
  RraOptions options = makePaperWalkRra();
  options.passes = {{1.0, 1.1, options.passes[0].tasks}};
  try {
    solveRra(standing.spec, standing.coordinates, standing.reaction, options, [](double fraction) {
      return fraction < 0.5;
    });
    FAIL() << "did not stop";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCancelled);
  }
}

ErrorCode findError(const RraOptions& options) {
  const Standing standing(75, 0, 0);
  try {
    solveRra(standing.spec, standing.coordinates, standing.reaction, options);
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::kInternal;
}

TEST(RraSolver, RefusesWhatDoesNotFit) {
  RraOptions late = makePaperWalkRra();
  late.passes = {{5.0, 6.0, late.passes[0].tasks}};
  EXPECT_EQ(findError(late), ErrorCode::kInputTimeRange);

  RraOptions few_actuators = makePaperWalkRra();
  few_actuators.actuators.pop_back();
  EXPECT_EQ(findError(few_actuators), ErrorCode::kSettingsValue);

  RraOptions unknown = makePaperWalkRra();
  unknown.passes[0].tasks[0].coordinate = "pelvis_t";
  EXPECT_EQ(findError(unknown), ErrorCode::kInputCoordinates);

  RraOptions no_pass = makePaperWalkRra();
  no_pass.passes.clear();
  EXPECT_EQ(findError(no_pass), ErrorCode::kSettingsValue);

  RraOptions no_body = makePaperWalkRra();
  no_body.adjusted_body = "trunk";
  EXPECT_EQ(findError(no_body), ErrorCode::kModelReference);
}

}  // namespace
}  // namespace gaitmill

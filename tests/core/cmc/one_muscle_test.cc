// One muscle holds or lifts a mass on a vertical rail: the smallest system with all of CMC in it.
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/cmc/cmc_solver.h"
#include "core/muscle/muscle.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr double kMass = 50;             // [kg]
constexpr double kHeight = 0.0;          // of the mass, where it is held [m]
constexpr double kCeiling = 0.36;        // origin of the muscle [m]
constexpr double kMaxForce = 2000;       // F0M [N]
constexpr double kOptimalLength = 0.10;  // l0M [m]

ModelSpec makeLift(TendonKind tendon, double max_force = kMaxForce) {
  ModelSpec spec;
  BodySpec body;
  body.name = "mass";
  body.mass = kMass;
  body.inertia = {1, 1, 1, 0, 0, 0};
  spec.bodies.push_back(body);
  JointSpec joint;
  joint.name = "rail";
  joint.kind = JointSpec::Kind::kSlider;
  joint.parent.body = "ground";
  joint.child.body = "mass";
  // The slider runs along the joint's x axis: turn it upward.
  joint.parent.orientation = joint.child.orientation = Eigen::Vector3d(0, 0, kPi / 2);
  joint.coordinates.emplace_back();
  joint.coordinates.back().name = "height";
  spec.joints.push_back(joint);
  MuscleSpec muscle;
  muscle.name = "lifter";
  muscle.max_isometric_force = max_force;
  muscle.optimal_fiber_length = kOptimalLength;
  muscle.tendon_slack_length = 0.26;
  muscle.tendon = tendon;
  muscle.path = {{"ground", {0, kCeiling, 0}}, {"mass", {0, 0, 0}}};
  spec.muscles.push_back(muscle);
  return spec;
}

CmcOptions makeOptions(double end_time) {
  CmcOptions options;
  options.end_time = end_time;
  options.barrier = 0;
  ActuatorSpec reserve;
  reserve.name = "reserve";
  reserve.coordinate = "height";
  reserve.optimal_force = 0.1;
  options.actuators.push_back(reserve);
  return options;
}

template <class Height>
CmcResult lift(const ModelSpec& spec, const CmcOptions& options, const Height& height) {
  const Model model(spec);
  const FreeCoordinates free(model);
  std::vector<double> time;
  for (int i = -50; i <= 150; ++i) {
    time.push_back(0.01 * i);
  }
  TimeSeries table = makeTimeSeries("lift", {"height"}, time);
  for (int i = 0; i < table.rowCount(); ++i) {
    table.values(i, 0) = height(time[static_cast<std::size_t>(i)]);
  }
  GroundReaction nothing;
  nothing.time = {0, 1, 2, 3};
  return solveCmc(
      model, ReferenceMotion(model, free, table), ExternalLoads(model, nothing), options);
}

double hold(double) {
  return kHeight;
}

// Force m g at path length kCeiling - kHeight: a = m g/(F0M fAL) with no passive force below l0M.
TEST(OneMuscle, RigidTendonHoldsTheMassWithItsClosedFormActivation) {
  const ModelSpec spec = makeLift(TendonKind::kRigid);
  const CmcResult result = lift(spec, makeOptions(1.0), hold);
  const Muscle muscle = makeMuscles(spec.muscles)[0];
  const double gain = muscle.calcRigidForceLine(kCeiling - kHeight, 0).gain;
  const int last = result.activation.rowCount() - 1;
  EXPECT_NEAR(result.activation.values(last, 0), kMass * kGravity / gain, tol(1e-3));
  EXPECT_NEAR(result.tendon_force.values(last, 0), kMass * kGravity, tol(0.5));
  EXPECT_NEAR(result.pose.values(last, 0), kHeight, tol(1e-5));
}

TEST(OneMuscle, ElasticTendonHoldsTheMassAtItsStaticEquilibrium) {
  const ModelSpec spec = makeLift(TendonKind::kElastic);
  const CmcResult result = lift(spec, makeOptions(1.0), hold);
  const Muscle muscle = makeMuscles(spec.muscles)[0];
  const int last = result.activation.rowCount() - 1;
  const double a = result.activation.values(last, 0);
  const double rest = muscle.solveStaticLength(a, kCeiling - kHeight);
  EXPECT_NEAR(muscle.calcTendonForce(rest, kCeiling - kHeight), kMass * kGravity, tol(1.0));
  EXPECT_NEAR(result.fiber_length.values(last, 0), rest, tol(1e-5));
  EXPECT_NEAR(result.actuator_force.values(last, 0), 0, tol(0.01));
}

TEST(OneMuscle, TwiceTheStrengthNeedsHalfTheActivation) {
  const CmcResult once = lift(makeLift(TendonKind::kRigid), makeOptions(1.0), hold);
  const CmcResult twice = lift(makeLift(TendonKind::kRigid, 2 * kMaxForce), makeOptions(1.0), hold);
  const int last = once.activation.rowCount() - 1;
  EXPECT_NEAR(once.activation.values(last, 0), 2 * twice.activation.values(last, 0), tol(2e-3));
}

// m (g + h'') along a slow sine of 2 cm.
TEST(OneMuscle, LiftingForceFollowsNewtonsLaw) {
  const double rate = 6;
  const auto height = [rate](double t) {
    return 0.02 * std::sin(rate * t);
  };
  const CmcResult result = lift(makeLift(TendonKind::kElastic), makeOptions(1.2), height);
  for (int row = 0; row < result.tendon_force.rowCount(); ++row) {
    const double t = result.tendon_force.time[static_cast<std::size_t>(row)];
    if (t < 0.3) {
      continue;
    }
    const double expected = kMass * (kGravity - rate * rate * height(t));
    EXPECT_NEAR(result.tendon_force.values(row, 0) + result.actuator_force.values(row, 0),
                expected,
                tol(0.01 * kMass * kGravity))
        << t;
    EXPECT_NEAR(result.pose.values(row, 0), height(t), tol(1e-4));
  }
}

// A muscle of 50 N cannot carry 490 N, and a bounded reserve neither.
TEST(OneMuscle, TooWeakAMuscleIsReportedWithTheMissingForce) {
  CmcOptions options = makeOptions(0.2);
  options.actuators[0].min_control = -10;
  options.actuators[0].max_control = 10;
  const CmcResult result = lift(makeLift(TendonKind::kRigid, 50), options, hold);
  ASSERT_FALSE(result.infeasible_windows.empty());
  const InfeasibleWindow::Missing& missing = result.infeasible_windows[0].missing.at(0);
  EXPECT_EQ(missing.coordinate, "height");
  EXPECT_GT(missing.force, kMass * kGravity - 60);
}

}  // namespace
}  // namespace gaitmill

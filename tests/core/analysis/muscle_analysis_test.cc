#include "core/analysis/muscle_analysis.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/muscle/muscle.h"
#include "tests/support/simple_models.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr double kAnchor = 0.36;        // where the muscle starts on the rail [m]
constexpr double kSlackLength = 0.26;   // [m]
constexpr double kOptimalLength = 0.1;  // [m]
constexpr double kPennation = 0.3;      // at the optimal length [rad]
constexpr double kMaxForce = 2000;      // [N]

/// A muscle along the rail pulls the body from x towards kAnchor: path length kAnchor - x.
Model makePuller(TendonKind tendon) {
  ModelSpec spec = makeSlider("sled");
  MuscleSpec muscle;
  muscle.name = "puller";
  muscle.max_isometric_force = kMaxForce;
  muscle.optimal_fiber_length = kOptimalLength;
  muscle.tendon_slack_length = kSlackLength;
  muscle.pennation_at_optimal = kPennation;
  muscle.tendon = tendon;
  muscle.path = {{"ground", {kAnchor, 0, 0}}, {"sled", {0, 0, 0}}};
  spec.muscles.push_back(muscle);
  return Model(spec);
}

TimeSeries makeCell(const std::string& label, double value) {
  TimeSeries table = makeTimeSeries(label, {label}, {0.0});
  table.values(0, 0) = value;
  return table;
}

/// One row of a record and what becomes of it.
struct Case {
  FiberSource source;
  double x;      // [m]
  double speed;  // [m/s]
  double activation;
  double force;         // [N]
  double fiber_length;  // [m]
};
MuscleAnalysis analyzeRow(const Model& model, const Case& row) {
  const TimeSeries pose = makeCell("x", row.x);
  const TimeSeries speed = makeCell("x", row.speed);
  const TimeSeries activation = makeCell("puller", row.activation);
  const TimeSeries force = makeCell("puller", row.force);
  const TimeSeries length = makeCell("puller", row.fiber_length);
  return analyzeMuscles(model,
                        {row.source,
                         pose,
                         speed,
                         activation,
                         force,
                         row.source == FiberSource::kSimulated ? &length : nullptr});
}

double only(const TimeSeries& table) {
  return table.values(0, 0);
}

// Height h = l0M sin(alpha0); along the tendon L - lsT; so l and alpha are those of a triangle.
TEST(MuscleAnalysis, ARigidTendonLeavesAllPathMotionToTheFiber) {
  const Model model = makePuller(TendonKind::kRigid);
  const double x = 0.01;
  const double u = 0.2;
  const double force = 300;
  const MuscleAnalysis result = analyzeRow(model, {FiberSource::kRigidActive, x, u, 0.5, force, 0});
  const double height = kOptimalLength * std::sin(kPennation);
  const double along = kAnchor - x - kSlackLength;
  const double length = std::hypot(along, height);
  EXPECT_NEAR(only(result.norm_fiber_lengths), length / kOptimalLength, tol(1e-14));
  EXPECT_NEAR(only(result.pennation_angles), std::atan2(height, along), tol(1e-14));
  const double fiber_speed = -u * along / length;
  EXPECT_NEAR(only(result.norm_fiber_velocities), fiber_speed / (10 * kOptimalLength), tol(1e-14));
  EXPECT_EQ(only(result.active_fiber_forces), force);
  EXPECT_EQ(only(result.passive_fiber_forces), 0);
  EXPECT_NEAR(only(result.muscle_powers), force * u, tol(1e-12));
  EXPECT_NEAR(only(result.fiber_active_powers), force * u, tol(1e-12));
  EXPECT_EQ(only(result.fiber_passive_powers), 0);
  EXPECT_NEAR(only(result.tendon_powers), 0, tol(1e-12));
}

TEST(MuscleAnalysis, PassiveForceOfARigidTendonMuscleIsTheStretchedFibersOwn) {
  const Model model = makePuller(TendonKind::kRigid);
  const double x = -0.06;  // the fiber stretches to about 1.6 optimal lengths
  const double force = 1500;
  const MuscleAnalysis result =
      analyzeRow(model, {FiberSource::kRigidWithPassive, x, 0.1, 0.5, force, 0});
  const Muscle muscle = makeMuscles(model.spec().muscles)[0];
  const double passive = muscle.calcRigidForceLine(kAnchor - x, 0.0).offset;
  ASSERT_GT(passive, 100);
  EXPECT_NEAR(only(result.passive_fiber_forces), passive, tol(1e-10));
  EXPECT_NEAR(only(result.active_fiber_forces), force - passive, tol(1e-10));
}

// The force that the fiber gives along the tendon is the tendon's, and so are the powers.
TEST(MuscleAnalysis, FiberAndTendonPowerMakeTheMusclesPower) {
  const Model model = makePuller(TendonKind::kElastic);
  const Muscle muscle = makeMuscles(model.spec().muscles)[0];
  for (const double fiber_length : {0.085, 0.1, 0.13}) {
    for (const double x : {-0.035, -0.01, 0.005}) {
      const double force = muscle.calcTendonForce(fiber_length, kAnchor - x);
      const MuscleAnalysis result =
          analyzeRow(model, {FiberSource::kSimulated, x, 0.7, 0.4, force, fiber_length});
      EXPECT_NEAR(
          only(result.active_fiber_forces) + only(result.passive_fiber_forces), force, tol(1e-9));
      EXPECT_NEAR(only(result.muscle_powers), force * 0.7, tol(1e-10));
      EXPECT_NEAR(only(result.fiber_active_powers) + only(result.fiber_passive_powers) +
                      only(result.tendon_powers),
                  only(result.muscle_powers),
                  tol(1e-8));
    }
  }
}

// The force on the sled is the tension, of which the fiber's passive part is told apart.
TEST(MuscleAnalysis, MomentsSplitIntoActiveAndPassive) {
  const Model model = makePuller(TendonKind::kElastic);
  const Muscle muscle = makeMuscles(model.spec().muscles)[0];
  const double force = muscle.calcTendonForce(0.14, kAnchor + 0.05);
  const MuscleAnalysis result =
      analyzeRow(model, {FiberSource::kSimulated, -0.05, 0.0, 0.1, force, 0.14});
  const TimeSeries& moments = result.muscle_moments;
  ASSERT_EQ(moments.labels,
            (std::vector<std::string>{"x_muscle_moment", "x_active_moment", "x_passive_moment"}));
  EXPECT_NEAR(moments.values(0, 0), force, tol(1e-10));
  EXPECT_NEAR(moments.values(0, 1), only(result.active_fiber_forces), tol(1e-8));
  EXPECT_NEAR(moments.values(0, 2), only(result.passive_fiber_forces), tol(1e-10));
  EXPECT_EQ(moments.units[0], "N");
}

TEST(MuscleAnalysis, AModelWithoutMusclesHasEmptyTables) {
  const Model model(makeSlider("sled"));
  const TimeSeries motion = makeCell("x", 0);
  const TimeSeries nothing = makeTimeSeries("forces", {}, {0.0});
  const MuscleAnalysis result =
      analyzeMuscles(model, {FiberSource::kRigidActive, motion, motion, nothing, nothing, nullptr});
  EXPECT_EQ(result.muscle_powers.columnCount(), 0);
  EXPECT_EQ(result.muscle_moments.columnCount(), 0);
  EXPECT_EQ(result.muscle_moments.rowCount(), 1);
}

}  // namespace
}  // namespace gaitmill

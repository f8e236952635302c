#include "core/validation/tendon_slack.h"

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/validation/posed_muscles.h"
#include "tests/core/validation/unit_muscle.h"
#include "tests/support/model_files.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

// The curves of Rajagopal2016.
const Muscle& curves() {
  static const Muscle shared = makeMuscleOfUnitSize(MuscleKind::kMillard2012);
  return shared;
}

TEST(TendonStretch, InvertsTheCurveFromToeToBeyondMaximumForce) {
  for (const MuscleKind kind :
       {MuscleKind::kMillard2012, MuscleKind::kThelen2003, MuscleKind::kSchutte1993}) {
    const Muscle tendon = makeMuscleOfUnitSize(kind);
    for (const double force : {1e-12, 1e-6, 0.003, 0.0078, 0.2, 0.66, 2.0 / 3, 1.0, 1.7}) {
      const double stretch = solveTendonStretch(tendon, force);
      EXPECT_NEAR(tendon.calcTendonForceLength(stretch).value, force, tol(2e-14)) << force;
    }
    EXPECT_EQ(solveTendonStretch(tendon, 0), 1.0);
    EXPECT_EQ(solveTendonStretch(tendon, -1), 1.0);
  }
  // spec/muscle.md 11.9, 10
  EXPECT_NEAR(solveTendonStretch(curves(), 0.0376044936314), 1.005, tol(1e-12));
  EXPECT_NEAR(solveTendonStretch(curves(), 1), 1.049, tol(1e-14));
  EXPECT_NEAR(
      solveTendonStretch(makeMuscleOfUnitSize(MuscleKind::kThelen2003), 1), 1.04, tol(1e-14));
}

// Without pennation and passive force: l_t = L - l~ l0, and the tendon carries 0.01 fAL(l~).
TEST(TendonSlack, UnpennatedMuscleByHand) {
  SlackInput input;
  input.path_length = 0.35;
  input.optimal_fiber_length = 0.05;
  input.norm_fiber_length = 1.0;
  const double stretch = solveTendonStretch(curves(), 0.01);
  EXPECT_NEAR(calcTendonSlack(input, curves()), 0.3 / stretch, tol(1e-15));
  // Between 1.002 (0.0073) and 1.003 (0.0163) of spec/muscle.md 11.9.
  EXPECT_GT(stretch, 1.002);
  EXPECT_LT(stretch, 1.003);
  input.tendon = TendonKind::kRigid;
  EXPECT_NEAR(calcTendonSlack(input, curves()), 0.3, tol(1e-15));
}

// Fixed height: sin(alpha) l~ = sin(alpha_o); a rigid tendon takes what the fiber leaves.
TEST(TendonSlack, PennationFollowsFromFixedHeight) {
  SlackInput input;
  input.path_length = 0.3;
  input.optimal_fiber_length = 0.1;
  input.norm_fiber_length = 0.8;
  input.pennation_at_optimal = std::asin(0.48);
  input.tendon = TendonKind::kRigid;
  // sin(alpha) = 0.6, cos(alpha) = 0.8.
  EXPECT_NEAR(calcTendonSlack(input, curves()), 0.3 - 0.8 * 0.1 * 0.8, tol(1e-15));
  input.pennation_at_optimal = std::asin(0.81);
  EXPECT_TRUE(std::isnan(calcTendonSlack(input, curves())));
}

// Where the model's own muscles rest is a target that must give back the slack length it has.
TEST(Calibration, ReturnsTheModelsSlackLengthsFromItsOwnRest) {
  const ModelSpec model = readOwnModel();
  std::vector<FiberTarget> targets;
  for (const SlackCalibration& row : calibrateTendonSlack(model, {})) {
    EXPECT_FALSE(row.is_given);
    EXPECT_EQ(row.slack_length, row.present_slack_length);
    FiberTarget target;
    target.muscle = row.muscle;
    target.norm_fiber_length = row.norm_fiber_length;
    targets.push_back(target);
  }
  ASSERT_EQ(targets.size(), 80u);
  for (const SlackCalibration& row : calibrateTendonSlack(model, targets)) {
    EXPECT_TRUE(row.is_given);
    EXPECT_NEAR(row.slack_length, row.present_slack_length, tol(1e-12)) << row.muscle;
  }
}

// And the other way: the calibrated model rests where it was told to.
TEST(Calibration, FibersRestAtTheirTargets) {
  ModelSpec model = readOwnModel();
  FiberTarget soleus;
  soleus.muscle = "soleus";
  soleus.norm_fiber_length = 0.9;
  FiberTarget semimem;
  semimem.muscle = "semimem_r";
  semimem.fiber_length = 0.075;
  const auto rows = calibrateTendonSlack(model, {soleus, semimem});
  model = applyCalibration(model, rows);
  int given = 0;
  for (const SlackCalibration& row : calibrateTendonSlack(model, {})) {
    const double l0 =
        model.muscles[static_cast<std::size_t>(model.findMuscle(row.muscle))].optimal_fiber_length;
    if (row.muscle == "soleus_r" || row.muscle == "soleus_l") {
      EXPECT_NEAR(row.norm_fiber_length, 0.9, tol(1e-12));
      ++given;
    } else if (row.muscle == "semimem_r") {
      EXPECT_NEAR(row.norm_fiber_length * l0, 0.075, tol(1e-13));
      ++given;
    }
  }
  EXPECT_EQ(given, 3);
}

// The only muscles whose target is known from elsewhere: the model of Arnold et al. (2010), a
// predecessor calibrated to the same measured fibers, has the same hip and the same straight paths
// of gluteus medius, but other optimal lengths, pennation and slack lengths. Its normalised fiber
// lengths in the pose, tendons taken as rigid (1 % of force stretches them by 0.1 mm), are the
// targets here.
TEST(Calibration, GluteusMediusMeetsTheFiberLengthsOfThePredecessor) {
  struct Predecessor {
    const char* muscle;
    double slack_length;
  };
  constexpr double kOptimal = 0.0733;
  constexpr double kPennation = 0.3572689;
  const ModelSpec model = readOwnModel();
  const auto rest = calibrateTendonSlack(model, {});
  for (const Predecessor& other :
       {Predecessor{"glmed1_r", 0.0565}, {"glmed2_r", 0.066}, {"glmed3_r", 0.046}}) {
    const double path_length =
        rest[static_cast<std::size_t>(model.findMuscle(other.muscle))].path_length;
    FiberTarget target;
    target.muscle = other.muscle;
    target.norm_fiber_length =
        std::hypot(kOptimal * std::sin(kPennation), path_length - other.slack_length) / kOptimal;
    const SlackCalibration row = calibrateTendonSlack(
        model, {target})[static_cast<std::size_t>(model.findMuscle(other.muscle))];
    EXPECT_NEAR(row.slack_length, row.present_slack_length, tol(1.5e-4)) << other.muscle;
  }
}

TEST(Calibration, RefusesTargetsThatMakeNoSense) {
  const ModelSpec model = readOwnModel();
  FiberTarget target;
  target.line = 7;
  target.norm_fiber_length = 1;
  const auto findCode = [&](const std::vector<FiberTarget>& targets) {
    try {
      calibrateTendonSlack(model, targets);
    } catch (const Error& error) {
      EXPECT_EQ(error.where().line, 7);
      return error.code();
    }
    return ErrorCode::kInternal;
  };
  target.muscle = "deltoid";
  EXPECT_EQ(findCode({target}), ErrorCode::kInputValue);
  target.muscle = "soleus";
  FiberTarget again = target;
  again.muscle = "soleus_l";
  EXPECT_EQ(findCode({target, again}), ErrorCode::kInputValue);
  target.norm_fiber_length = 0.3;  // shorter than its height of sin(21.9 deg)
  EXPECT_EQ(findCode({target}), ErrorCode::kInputValue);
  target.norm_fiber_length = 9;  // longer than the path
  EXPECT_EQ(findCode({target}), ErrorCode::kInputValue);
}

}  // namespace
}  // namespace gaitmill

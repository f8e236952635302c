#include "core/rra/mass_fit.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/swaying_trial.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

struct Fitted {
  ModelSpec model;
  std::vector<MassAdjustment> steps;
};

Fitted fit(const SwayingTrial& trial, const ModelSpec& wrong, const RraOptions& options) {
  const Model model(wrong);
  const FreeCoordinates free(model);
  const ExternalLoads loads(model, trial.reaction);
  const ReferenceMotion reference(model, free, prepareDesiredMotion(trial.coordinates, options));
  Fitted fitted;
  fitted.model = wrong;
  fitted.steps = fitMassAndCenter(reference, loads, options, options.passes[0], fitted.model);
  return fitted;
}

Eigen::Vector3d findTrunkCenter(const ModelSpec& model) {
  return model.bodies[static_cast<std::size_t>(model.findBody("torso"))].mass_center;
}

// Forces without noise determine both: five kilograms and three centimetres are found back.
TEST(MassFit, FindsMassAndMassCenterBack) {
  const SwayingTrial trial;
  const Fitted fitted = fit(trial, trial.misjudge(5, 0.03, -0.01), trial.makeOptions());
  EXPECT_NEAR(fitted.model.calcTotalMass(), trial.spec.calcTotalMass(), tol(1e-4));
  const Eigen::Vector3d center = findTrunkCenter(fitted.model);
  EXPECT_NEAR((center - findTrunkCenter(trial.spec)).norm(), 0, tol(1e-5));
  const ResidualSum& left = fitted.steps.back().average_after;
  EXPECT_NEAR(left.force.y(), 0, tol(1e-6));
  EXPECT_NEAR(left.moment.x(), 0, tol(1e-6));
  EXPECT_NEAR(left.moment.z(), 0, tol(1e-6));
}

TEST(MassFit, StepsAddUpToWhatTheModelUnderwent) {
  const SwayingTrial trial;
  const ModelSpec wrong = trial.misjudge(-3, -0.02, 0.01);
  const Fitted fitted = fit(trial, wrong, trial.makeOptions());
  const MassAdjustment total = sumAdjustments(fitted.steps);
  EXPECT_LE(fitted.steps.size(), 5U);
  EXPECT_EQ(total.mass_before, wrong.calcTotalMass());
  EXPECT_NEAR(total.mass_after, fitted.model.calcTotalMass(), tol(1e-9));
  EXPECT_NEAR(total.mass_change, 3, tol(1e-3));
  const Eigen::Vector3d moved = findTrunkCenter(fitted.model) - findTrunkCenter(wrong);
  EXPECT_NEAR(moved.x(), -total.shift_x, tol(1e-12));
  EXPECT_NEAR(moved.z(), -total.shift_z, tol(1e-12));
  EXPECT_EQ(moved.y(), 0);
  EXPECT_EQ(total.average_before.force, fitted.steps.front().average_before.force);
}

// Newton needs few steps because the averages are straight lines in mass and mass center.
TEST(MassFit, LastStepIsNone) {
  const SwayingTrial trial;
  const Fitted fitted = fit(trial, trial.misjudge(5, 0.03, -0.01), trial.makeOptions());
  EXPECT_LE(fitted.steps.size(), 4U);
  EXPECT_LT(std::abs(fitted.steps.back().mass_change), 1e-6);
}

TEST(MassFit, StopsAtTheLimitsAndSaysSo) {
  const SwayingTrial trial;
  RraOptions options = trial.makeOptions();
  options.max_mass_change = 0.02;
  options.max_mass_center_shift = 0.01;
  const ModelSpec wrong = trial.misjudge(5, 0.03, -0.005);
  const Fitted fitted = fit(trial, wrong, options);
  const MassAdjustment total = sumAdjustments(fitted.steps);
  EXPECT_TRUE(total.mass_limited);
  EXPECT_TRUE(total.shift_limited);
  EXPECT_NEAR(total.mass_change, -0.02 * wrong.calcTotalMass(), tol(1e-9));
  EXPECT_NEAR(total.shift_x, 0.01, tol(1e-12));
  EXPECT_LT(std::abs(total.shift_z), 0.01);

  const MassAdjustment free = sumAdjustments(fit(trial, wrong, trial.makeOptions()).steps);
  EXPECT_FALSE(free.mass_limited);
  EXPECT_FALSE(free.shift_limited);
}

}  // namespace
}  // namespace gaitmill

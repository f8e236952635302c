#include "core/rra/rra_autopilot.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/grf_reader.h"
#include "core/io/table_reader.h"
#include "core/rra/rra_limits.h"
#include "tests/support/shared_data.h"
#include "tests/support/swaying_trial.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

const SwayingTrial& swaying() {
  static const SwayingTrial trial;
  return trial;
}

RraResult solve(const ModelSpec& model, const RraOptions& options, const Progress& progress = {}) {
  return solveRra(model, swaying().coordinates, swaying().reaction, options, progress);
}

TEST(RraAutopilot, FindsMassAndTrunkBackAndThenHoldsAllLimits) {
  const RraResult result = solve(swaying().misjudge(5, 0.03, -0.01), swaying().makeOptions());
  EXPECT_TRUE(result.converged);
  const ModelSpec& model = result.keptPass().adjusted_model;
  EXPECT_NEAR(model.calcTotalMass(), swaying().spec.calcTotalMass(), tol(1e-4));
  const auto torso = static_cast<std::size_t>(model.findBody("torso"));
  EXPECT_NEAR((model.bodies[torso].mass_center - swaying().spec.bodies[torso].mass_center).norm(),
              0,
              tol(1e-5));
  EXPECT_EQ(result.keptPass().merit, 0);
  EXPECT_TRUE(result.warnings.empty());
}

// Weights so small that coordinates drift off, and a mass center that may not move: the autopilot
// has to search.
RraOptions makeHardOptions() {
  RraOptions options = swaying().makeOptions();
  options.max_passes = 5;
  options.adjust_mass = options.adjust_mass_center = false;
  options.limits.rotation_rms = toRadians(0.1);
  options.limits.translation_rms = 0.001;
  options.limits.force_rms = 12;
  for (TrackingTask& task : options.passes[0].tasks) task.weight = 100;
  return options;
}

const RraResult& solveHard() {
  static const RraResult result = solve(swaying().misjudge(1.4, 0.02, -0.01), makeHardOptions());
  return result;
}

double findWeight(const RraPassOptions& pass, const std::string& coordinate) {
  for (const TrackingTask& task : pass.tasks) {
    if (task.coordinate == coordinate) return task.weight;
  }
  return -1;
}

TEST(RraAutopilot, EveryChangeOfWeightIsInTheAudit) {
  const RraResult& result = solveHard();
  ASSERT_GE(result.passes.size(), 3U);
  for (std::size_t i = 0; i < result.passes.size(); ++i) {
    const RraPassResult& pass = result.passes[i];
    SCOPED_TRACE("pass " + std::to_string(i + 1));
    EXPECT_FALSE(pass.decision.empty());
    EXPECT_EQ(pass.deviations.size(), 29U);
    EXPECT_EQ(pass.from_pass > 0, i > 0);
    EXPECT_EQ(pass.weight_changes.empty(), i == 0);
    const RraPassOptions base =
        i == 0 ? makeHardOptions().passes[0]
               : result.passes[static_cast<std::size_t>(pass.from_pass) - 1].used;
    std::map<std::string, double> expected;
    for (const TrackingTask& task : base.tasks) expected[task.coordinate] = task.weight;
    for (const WeightChange& change : pass.weight_changes) {
      EXPECT_EQ(expected.at(change.coordinate), change.before);
      EXPECT_NE(change.before, change.after);
      EXPECT_FALSE(change.reason.empty());
      expected[change.coordinate] = change.after;
    }
    for (const auto& [coordinate, weight] : expected) {
      EXPECT_EQ(findWeight(pass.used, coordinate), weight) << coordinate;
    }
  }
}

TEST(RraAutopilot, RaisesWhatStraysAndLowersWhatHasRoom) {
  const RraResult& result = solveHard();
  const RraPassResult& second = result.passes[1];
  int raised = 0;
  for (const WeightChange& change : second.weight_changes) {
    const auto& deviations = result.passes[0].deviations;
    const auto found = std::find_if(deviations.begin(), deviations.end(), [&](const auto& d) {
      return d.coordinate == change.coordinate;
    });
    ASSERT_NE(found, deviations.end());
    EXPECT_EQ(change.after > change.before, found->share > 1) << change.coordinate;
    raised += change.after > change.before ? 1 : 0;
  }
  EXPECT_GT(raised, 0);
}

TEST(RraAutopilot, KeepsThePassOfTheSmallestMerit) {
  const RraResult& result = solveHard();
  double smallest = result.passes[0].merit;
  for (const RraPassResult& pass : result.passes) smallest = std::min(smallest, pass.merit);
  // A gain of less than a percent is none.
  EXPECT_LE(result.keptPass().merit, smallest / 0.99);
  EXPECT_LT(result.keptPass().merit, result.passes[0].merit);
  EXPECT_EQ(result.keptPass().merit,
            calcMerit(listFigures(result.keptPass(), result.options.limits)));
  for (const RraPassResult& pass : result.passes) {
    const bool kept = &pass == &result.keptPass();
    EXPECT_EQ(pass.coordinates.rowCount() > 0, kept);
    EXPECT_EQ(pass.adjusted_model.bodies.empty(), !kept);
  }
}

TEST(RraAutopilot, NamesTheCauseWhereLimitsDoNotHold) {
  const RraResult& result = solveHard();
  ASSERT_FALSE(result.converged);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_NE(result.warnings[0].find("limits do not hold"), std::string::npos);
  EXPECT_NE(result.warnings[0].find("likely"), std::string::npos);
}

TEST(RraAutopilot, RefusesToBelieveAMassThatIsFarOff) {
  const RraResult result = solve(swaying().misjudge(-12, 0, 0), swaying().makeOptions());
  const MassAdjustment& adjustment = result.passes[0].adjustment;
  EXPECT_TRUE(adjustment.mass_limited);
  EXPECT_NEAR(adjustment.mass_change, 0.1 * adjustment.mass_before, tol(1e-9));
  ASSERT_FALSE(result.warnings.empty());
  EXPECT_NE(result.warnings[0].find("wrong mass"), std::string::npos);
}

TEST(RraAutopilot, DoesAsManyPassesAsAllowed) {
  RraOptions options = makeHardOptions();
  options.max_passes = 1;
  EXPECT_EQ(solve(swaying().misjudge(1.4, 0.02, -0.01), options).passes.size(), 1U);
  EXPECT_LE(solveHard().passes.size(), 5U);
}

TEST(RraAutopilot, GivesTheSameBitsTwice) {
  const RraResult again = solve(swaying().misjudge(1.4, 0.02, -0.01), makeHardOptions());
  const RraResult& first = solveHard();
  ASSERT_EQ(again.passes.size(), first.passes.size());
  EXPECT_EQ(again.kept, first.kept);
  EXPECT_EQ(again.keptPass().coordinates.values, first.keptPass().coordinates.values);
  EXPECT_EQ(again.keptPass().actuator_forces.values, first.keptPass().actuator_forces.values);
  for (std::size_t i = 0; i < first.passes.size(); ++i) {
    EXPECT_EQ(again.passes[i].merit, first.passes[i].merit);
    EXPECT_EQ(again.passes[i].decision, first.passes[i].decision);
  }
}

TEST(RraAutopilot, StopsWhenAskedToInAnyPass) {
  for (const double until : {0.0, 0.1, 0.5}) {
    try {
      solve(swaying().misjudge(1.4, 0.02, -0.01), makeHardOptions(), [&](double fraction) {
        return fraction < until;
      });
      ADD_FAILURE() << "did not stop at " << until;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kCancelled);
    }
  }
}

class RraAutopilotTrials : public SharedDataTest {
 protected:
  RraResult solveTrial(const std::string& name,
                       const std::string& forces,
                       RraOptions options) const {
    const std::string folder = "reference/" + name;
    const ModelSpec model = readModelFile(shared(folder + "/scale/subject_scaled.osim"));
    const std::string motion = shared(folder + "/ik/ik.mot");
    options.strategy = RraStrategy::kAutopilot;
    // The published weights of the walk's last pass, for either: the autopilot is to cope.
    options.passes = {{options.passes[0].start_time,
                       options.passes[0].end_time,
                       makePaperWalkRra().passes[1].tasks}};
    options.max_passes = 6;
    return solveRra(model,
                    toCoordinates(readTable(readFile(motion), motion), model),
                    readGroundReaction(readTable(readFile(shared(forces)), forces), GrfOptions()),
                    options);
  }
};

TEST_F(RraAutopilotTrials, LimitsHoldOnThePapersWalkAndRun) {
  const RraResult walk = solveTrial("walk", "data/walk/grf_walk.mot", makePaperWalkRra());
  EXPECT_TRUE(walk.converged) << walk.passes.back().decision;
  EXPECT_LT(std::abs(walk.passes[0].adjustment.mass_change), 1);
  const RraResult run =
      solveTrial("run", "data/run/paper_subject01/grf_run.mot", makePaperRunRra());
  EXPECT_TRUE(run.converged) << run.passes.back().decision;
  EXPECT_LT(std::abs(run.passes[0].adjustment.mass_change), 1);
}

}  // namespace
}  // namespace gaitmill

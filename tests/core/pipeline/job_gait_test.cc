// From the files of a job to feet, cycles and the window.

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/pipeline/gait_reading.h"
#include "core/pipeline/job.h"
#include "tests/support/sample_input.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

const PipelineEvents& silence() {
  static const PipelineEvents events;
  return events;
}

Job open(const TrialInput& input, const std::string& settings) {
  return openJob(input, {"settings.json", settings}, "models", silence(), false);
}

void replaceAll(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
}

/// The sample with columns of plates 1 (right) and 2 (left) instead of feet.
TrialInput makeNumbered() {
  TrialInput input = readSampleInput();
  for (const std::string kind : {"force", "torque"}) {
    replaceAll(input.ground_reaction->bytes, "ground_" + kind + "_r_", "ground_" + kind + "_1_");
    replaceAll(input.ground_reaction->bytes, "ground_" + kind + "_l_", "ground_" + kind + "_2_");
  }
  return input;
}

// The sample is one right cycle, 0.335 to 1.480 s, in 1.74 s.
TEST(JobGait, OneCycleIsSimulatedByDefault) {
  const TrialInput input = readSampleInput();
  const Job job = open(input, "{}");
  ASSERT_TRUE(job.gait.window && job.gait.window->cycle);
  EXPECT_EQ(job.gait.window->cycle->foot, Foot::kRight);
  for (const Stage stage : {Stage::kRra, Stage::kId, Stage::kSo, Stage::kCmc}) {
    const TimeRange range = findDefaultRange(stage, job);
    EXPECT_NEAR(range.start, 0.335 - kLeadIn, tol(0.006));
    EXPECT_NEAR(range.end, 1.480 + kLeadOut, tol(0.006));
  }
  EXPECT_EQ(job.gait.kind, GaitKind::kWalking);
}

TEST(JobGait, NumberedPlatesNeedNoAssignment) {
  const TrialInput named_input = readSampleInput();
  const TrialInput numbered_input = makeNumbered();
  const Job named = open(named_input, "{}");
  const Job numbered = open(numbered_input, "{}");
  ASSERT_EQ(numbered.reaction.forces.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(numbered.reaction.forces[i].body, named.reaction.forces[i].body);
    EXPECT_EQ(numbered.reaction.forces[i].force, named.reaction.forces[i].force);
  }
  EXPECT_EQ(numbered.gait.window->range.start, named.gait.window->range.start);
}

TEST(JobGait, AStatedContactChangesTheBody) {
  const TrialInput input = readSampleInput();
  const Job job = open(input, R"({"trial": {"contacts": [
      {"plate": "ground_force_r", "time_s": 0.7, "foot": "left"},
      {"plate": "ground_force_r", "time_s": 1.6, "foot": "none"}]}})");
  ASSERT_EQ(job.reaction.forces.size(), 2U);
  EXPECT_EQ(job.reaction.forces[0].body, "calcn_l");
  EXPECT_EQ(job.reaction.forces[1].body, "calcn_l");
}

TEST(JobGait, ACycleThatIsNotThereIsRefusedByName) {
  const TrialInput input = readSampleInput();
  try {
    open(input, R"({"trial": {"cycle": {"foot": "right", "number": 9}}})");
    FAIL() << "there is no ninth cycle";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kSettingsValue);
    EXPECT_EQ(error.where().field, "trial.cycle");
  }
}

TEST(JobGait, StatedRangesWin) {
  const TrialInput input = readSampleInput();
  // Behind a residual reduction with its own range everything that it leaves is used.
  const Job reduced = open(input, R"({"rra": {"time_range_s": [0.1, 1.7]}})");
  EXPECT_EQ(findDefaultRange(Stage::kCmc, reduced).start, -std::numeric_limits<double>::infinity());
  // What later stages ask for is what residual reduction makes.
  const Job later = open(input, R"({"cmc": {"time_range_s": [0.1, 0.5]}})");
  EXPECT_EQ(findDefaultRange(Stage::kRra, later).start, 0.1);
  EXPECT_NEAR(findDefaultRange(Stage::kRra, later).end, 0.5 + kLeadOut, tol(1e-12));
  const Job cycle = open(input, R"({"trial": {"gait_cycle_s": [0.4, 1.4]}})");
  EXPECT_NEAR(findDefaultRange(Stage::kRra, cycle).start, 0.4 - kLeadIn, tol(1e-12));
}

TEST(JobGait, WithoutForcesTheFieldIsNamed) {
  TrialInput input = readSampleInput();
  input.ground_reaction.reset();
  try {
    open(input, "{}");
    FAIL() << "dynamics need forces";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInputMissing);
    EXPECT_EQ(error.where().field, "grf");
    EXPECT_NE(error.message().find("stages.last"), std::string::npos);
  }
  const Job job = open(input, R"({"stages": {"last": "ik"}})");
  EXPECT_FALSE(job.gait.window.has_value());
  EXPECT_TRUE(findGaitCycle(job).has_value());
  for (const GaitEvent& event : job.gait.events) {
    EXPECT_EQ(event.source, GaitEvent::Source::kMarkers);
  }
}

TEST(JobGait, DecisionsSayFeetGaitAndWindow) {
  const TrialInput input = makeNumbered();
  const Job job = open(input, "{}");
  std::vector<std::string> topics;
  for (const Decision& decision : job.decisions) {
    topics.push_back(decision.topic);
    if (decision.topic == "foot_of_plate") {
      EXPECT_EQ(decision.origin, Decision::Origin::kDetected);
      EXPECT_GT(decision.confidence, kLeastConfidence);
      EXPECT_FALSE(decision.evidence.empty());
    }
  }
  for (const char* topic : {"foot_of_plate", "gait", "simulated_window"}) {
    EXPECT_NE(std::find(topics.begin(), topics.end(), topic), topics.end()) << topic;
  }
}

}  // namespace
}  // namespace gaitmill

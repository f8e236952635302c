// A run that goes on behind its checkpoints ends where the undisturbed one ends, to the bit.
#include "core/pipeline/checkpoint.h"

#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "tests/support/sample_input.h"

namespace gaitmill {
namespace {

InputFile readDefaults() {
  return readInput("models/settings/default.json");
}

struct ObservedRun {
  PipelineResult result;
  std::vector<StageOutcome> outcomes;
  std::vector<std::string> warnings;

  std::vector<std::string> copyCheckpoints(std::size_t count) const {
    std::vector<std::string> checkpoints;
    for (std::size_t i = 0; i < count; ++i) {
      checkpoints.push_back(outcomes[i].checkpoint);
    }
    return checkpoints;
  }
};

ObservedRun observe(const std::vector<std::string>& checkpoints = {}) {
  ObservedRun run;
  PipelineEvents events;
  events.stage_done = [&run](const StageOutcome& outcome) {
    run.outcomes.push_back(outcome);
  };
  events.warn = [&run](const std::string& warning) {
    run.warnings.push_back(warning);
  };
  run.result = Pipeline().run(readSampleInput(), readDefaults(), events, checkpoints);
  return run;
}

const ObservedRun& observeWholeSample() {
  static const ObservedRun run = observe();
  return run;
}

/// The same labels, units and bits; NaN equals NaN.
void expectSameBits(const TimeSeries& a, const TimeSeries& b) {
  EXPECT_EQ(a.labels, b.labels) << a.name;
  EXPECT_EQ(a.units, b.units) << a.name;
  EXPECT_EQ(a.time, b.time) << a.name;
  ASSERT_EQ(a.values.size(), b.values.size()) << a.name;
  EXPECT_EQ(std::memcmp(a.values.data(),
                        b.values.data(),
                        static_cast<std::size_t>(a.values.size()) * sizeof(double)),
            0)
      << a.name;
}

void expectSameTables(const std::map<std::string, TimeSeries>& a,
                      const std::map<std::string, TimeSeries>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [name, table] : a) {
    ASSERT_EQ(b.count(name), 1U) << name;
    expectSameBits(table, b.at(name));
  }
}

/// The summary without the processor time of the stages that were computed again.
nlohmann::json parseWithoutTimes(const std::string& summary, std::size_t resumed) {
  nlohmann::json json = nlohmann::json::parse(summary);
  for (std::size_t stage = resumed; stage < kStageCount; ++stage) {
    nlohmann::json& entry = json["stages"][stageName(static_cast<Stage>(stage))];
    entry.erase("seconds");
    entry.erase("real_time_factor");
  }
  return json;
}

class ResumedAfter : public ::testing::TestWithParam<std::size_t> {};

TEST_P(ResumedAfter, EndsWhereTheUndisturbedRunEnds) {
  const std::size_t done = GetParam();
  const ObservedRun& whole = observeWholeSample();
  const ObservedRun resumed = observe(whole.copyCheckpoints(done));
  ASSERT_EQ(resumed.outcomes.size(), kStageCount - done);
  expectSameTables(whole.result.tables, resumed.result.tables);
  expectSameTables(whole.result.cycle_tables, resumed.result.cycle_tables);
  ASSERT_EQ(whole.result.files.size(), resumed.result.files.size());
  for (const auto& [name, bytes] : whole.result.files) {
    if (name != "summary.json") {
      EXPECT_EQ(bytes, resumed.result.files.at(name)) << name;
    }
  }
  EXPECT_EQ(parseWithoutTimes(whole.result.summary_json, done),
            parseWithoutTimes(resumed.result.summary_json, done));
  EXPECT_EQ(whole.result.warnings, resumed.result.warnings);
}

INSTANTIATE_TEST_SUITE_P(Checkpoint, ResumedAfter, ::testing::Range<std::size_t>(1, 7));

TEST(Checkpoint, OfAResumedRunIsTheOneOfTheUndisturbedRunButForItsTime) {
  const ObservedRun& whole = observeWholeSample();
  // Without processor time the bytes are the same: scale comes again from itself.
  const ObservedRun resumed = observe(whole.copyCheckpoints(6));
  EXPECT_TRUE(resumed.outcomes.empty());
  EXPECT_EQ(resumed.result.summary_json, whole.result.summary_json);
}

TEST(Checkpoint, WarningsAreSaidOnce) {
  const ObservedRun& whole = observeWholeSample();
  const ObservedRun resumed = observe(whole.copyCheckpoints(5));
  EXPECT_LT(resumed.warnings.size(), whole.warnings.size() + 1);
  EXPECT_EQ(resumed.result.warnings, whole.result.warnings);
  EXPECT_TRUE(observe(whole.copyCheckpoints(6)).warnings.empty());
}

ErrorCode findRefusal(const std::vector<std::string>& checkpoints,
                      const TrialInput& input = readSampleInput()) {
  try {
    Pipeline().run(input, readDefaults(), {}, checkpoints);
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::kUsage;
}

TEST(Checkpoint, DamagedBytesAreRefused) {
  const std::string good = observeWholeSample().outcomes.front().checkpoint;
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{10}, std::size_t{29}, good.size() - 1}) {
    EXPECT_EQ(findRefusal({good.substr(0, length)}), ErrorCode::kCheckpointUnusable) << length;
  }
  for (const std::size_t at :
       {std::size_t{3}, std::size_t{25}, std::size_t{40}, good.size() / 2, good.size() - 1}) {
    std::string flipped = good;
    flipped[at] = static_cast<char>(flipped[at] ^ 1);
    EXPECT_EQ(findRefusal({flipped}), ErrorCode::kCheckpointUnusable) << at;
  }
}

TEST(Checkpoint, OfAnotherStageOrOtherInputIsRefused) {
  const ObservedRun& whole = observeWholeSample();
  EXPECT_EQ(findRefusal({whole.outcomes[1].checkpoint}), ErrorCode::kCheckpointUnusable);
  TrialInput heavier = readSampleInput();
  heavier.mass += 1;
  EXPECT_EQ(findRefusal({whole.outcomes[0].checkpoint}, heavier), ErrorCode::kCheckpointUnusable);
  TrialInput renamed = readSampleInput();
  renamed.markers->bytes += "\n";
  EXPECT_EQ(findRefusal({whole.outcomes[0].checkpoint}, renamed), ErrorCode::kCheckpointUnusable);
  EXPECT_EQ(findRefusal(std::vector<std::string>(7, whole.outcomes[0].checkpoint)),
            ErrorCode::kCheckpointUnusable);
}

// What a stage hands on and what the whole run ends with are the same things.
TEST(StageOutcome, TheLastOneOfEachNameIsTheResult) {
  const ObservedRun& whole = observeWholeSample();
  std::map<std::string, TimeSeries> tables;
  std::map<std::string, std::string> files;
  for (const StageOutcome& outcome : whole.outcomes) {
    for (const auto& [name, table] : outcome.tables) {
      tables[name] = table;
    }
    for (const auto& [name, bytes] : outcome.files) {
      files[name] = bytes;
    }
  }
  expectSameTables(tables, whole.result.tables);
  EXPECT_EQ(files, whole.result.files);
}

TEST(StageOutcome, HoldsWhatTheStageMakes) {
  const std::vector<std::vector<std::string>> expected = {
      {},
      {"emg", "kinematics", "marker_errors", "measured_markers"},
      {"ground_reactions", "kinematics", "residuals", "tracking_errors"},
      {"joint_powers", "moments"},
      {"activations", "emg", "forces", "reserves"},
      {"activations",
       "active_fiber_forces",
       "emg",
       "excitations",
       "fiber_active_powers",
       "fiber_lengths",
       "fiber_passive_powers",
       "fiber_velocities",
       "forces",
       "joint_reactions",
       "kinematics",
       "moments",
       "muscle_moments",
       "muscle_powers",
       "muscle_work",
       "norm_fiber_lengths",
       "norm_fiber_velocities",
       "passive_fiber_forces",
       "pennation_angles",
       "reserves",
       "residuals",
       "tendon_powers",
       "tracking_errors"}};
  const ObservedRun& whole = observeWholeSample();
  ASSERT_EQ(whole.outcomes.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    std::vector<std::string> names;
    for (const auto& [name, table] : whole.outcomes[i].tables) {
      names.push_back(name);
      EXPECT_EQ(table.units.size(), table.labels.size()) << name;
    }
    EXPECT_EQ(names, expected[i]) << stageName(whole.outcomes[i].stage);
  }
}

}  // namespace
}  // namespace gaitmill

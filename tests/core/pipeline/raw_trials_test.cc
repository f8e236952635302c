#include <optional>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/io/files.h"
#include "core/pipeline/pipeline.h"
#include "tests/support/shared_data.h"

namespace gaitmill {
namespace {

/// A laboratory's files with nothing but the person's mass and height.
struct RawTrial {
  std::string static_markers;    ///< empty = none was recorded
  std::string static_markers_2;  ///< empty = none
  std::string markers;
  std::string forces;
  double mass;
  double height;
};

class RawTrialsTest : public SharedDataTest {
 protected:
  nlohmann::json run(const RawTrial& trial) {
    TrialInput input;
    const auto read = [&](const std::string& name) -> std::optional<InputFile> {
      if (name.empty()) {
        return std::nullopt;
      }
      return InputFile{name.substr(name.rfind('/') + 1), readFile(shared("data/" + name))};
    };
    input.static_markers = read(trial.static_markers);
    input.static_markers_2 = read(trial.static_markers_2);
    input.markers = read(trial.markers);
    input.ground_reaction = read(trial.forces);
    input.mass = trial.mass;
    input.height = trial.height;
    const PipelineResult result =
        Pipeline().run(input, {"default.json", readFile("models/settings/default.json")}, {});
    EXPECT_EQ(result.tables.count("activations"), 1U);
    EXPECT_EQ(result.tables.at("activations").columnCount(), 80);
    return nlohmann::json::parse(result.summary_json);
  }
  /// Not worse than "warn".
  void expectUsable(const RawTrial& trial) {
    const nlohmann::json summary = run(trial);
    EXPECT_NE(summary["verdict"], "fail") << summary["quality"]["reasons"].dump(2);
    EXPECT_TRUE(summary["stages"]["cmc"]["finished"].get<bool>());
  }
};

const RawTrial kRun = {"run/paper_subject01/static_run.trc",
                       "",
                       "run/paper_subject01/motion_capture_run.trc",
                       "run/paper_subject01/grf_run.mot",
                       72.84,
                       1.8};
const RawTrial kWalk = {"walk/static_walk_1.trc",
                        "walk/static_walk_2.trc",
                        "walk/motion_capture_walk.trc",
                        "walk/grf_walk.mot",
                        85.0668,
                        1.829};

TEST_F(RawTrialsTest, WalkFromRawFilesToActivations) {
  expectUsable(kWalk);
}

TEST_F(RawTrialsTest, WalkWithoutAStaticTrial) {
  RawTrial trial = kWalk;
  trial.static_markers.clear();
  trial.static_markers_2.clear();
  expectUsable(trial);
}

TEST_F(RawTrialsTest, RunOfHamner2010FromRawFilesToActivations) {
  expectUsable({"run/hamner2010/subject02_static.trc",
                "",
                "run/hamner2010/subject02_running.trc",
                "run/hamner2010/subject02_running_grf.mot",
                65.9,
                1.83});
}

TEST_F(RawTrialsTest, RunWithoutAnyStaticTrial) {
  expectUsable({"",
                "",
                "run/hamner2013_subject04/run400/markers.trc",
                "run/hamner2013_subject04/run400/grf.mot",
                80.47,
                1.772});
}

// The paper's run goes through as well; a reserve is all that its verdict may fail on.
TEST_F(RawTrialsTest, OnlyAReserveFailsThePapersRun) {
  const nlohmann::json summary = run(kRun);
  EXPECT_TRUE(summary["stages"]["cmc"]["finished"].get<bool>());
  ASSERT_GT(summary["quality"]["checks"].size(), 15U);
  for (const nlohmann::json& check : summary["quality"]["checks"]) {
    const bool is_reserve = check.dump().find("reserve") != std::string::npos;
    EXPECT_TRUE(check["verdict"] != "fail" || is_reserve) << check;
  }
}

}  // namespace
}  // namespace gaitmill

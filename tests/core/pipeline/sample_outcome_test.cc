#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "core/io/files.h"
#include "core/io/osim_reader.h"
#include "core/pipeline/pipeline.h"
#include "core/pipeline/sample_files.h"
#include "tests/support/sample_input.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

using Json = nlohmann::json;

// The embedded trial through all stages with the default settings, once for all tests.
class SampleOutcome : public ::testing::Test {
 protected:
  struct Run {
    PipelineResult result;
    std::map<Stage, std::vector<double>> progress;
  };

  static const Run& run() {
    static const Run finished = [] {
      Run fresh;
      PipelineEvents events;
      events.progress = [&fresh](Stage stage, double fraction) {
        fresh.progress[stage].push_back(fraction);
        return true;
      };
      fresh.result =
          Pipeline().run(readSampleInput(), readInput("models/settings/default.json"), events);
      return fresh;
    }();
    return finished;
  }

  static Json summary() { return Json::parse(run().result.summary_json); }
};

TEST_F(SampleOutcome, ProgressRunsFromStartToEndOfEachStage) {
  EXPECT_EQ(run().progress.size(), 6U);
  for (const auto& [stage, fractions] : run().progress) {
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end())) << stageName(stage);
    EXPECT_EQ(fractions.back(), 1.0) << stageName(stage);
  }
}

TEST_F(SampleOutcome, FindsThePersonInTheStandingTrial) {
  const std::string bytes = run().result.files.at("scaled_model.osim");
  const ModelSpec scaled = readOsim(bytes, "scaled_model.osim");
  const ModelSpec truth = makeSampleSubject(
      readOsim(readFile("models/rajagopal2016/rajagopal2016.osim"), "rajagopal2016.osim"));
  EXPECT_NEAR(scaled.calcTotalMass(), truth.calcTotalMass(), tol(1e-9));
  // Lengths of segments: markers 0.2 to 0.4 m apart, noise 1 mm averaged over 51 frames, 0.5 mm at
  // most.
  const auto lengthOf = [](const ModelSpec& model, const char* muscle) {
    return model.muscles[static_cast<std::size_t>(model.findMuscle(muscle))].optimal_fiber_length;
  };
  for (const char* muscle : {"recfem_r", "soleus_r", "vasint_l"}) {
    EXPECT_NEAR(lengthOf(scaled, muscle) / lengthOf(truth, muscle), 1.0, tol(0.002)) << muscle;
  }
}

// The trial is dynamically consistent, so that what is left at the pelvis comes from marker noise:
// below 1 % of body weight and 5 N.m.
TEST_F(SampleOutcome, LeavesLittleAtThePelvis) {
  const Json residuals = summary().at("quality").at("residuals");
  for (const char* force : {"FX", "FY", "FZ"}) {
    EXPECT_LT(residuals.at(force).at("peak_n").get<double>(), 0.01 * 70 * kGravity) << force;
  }
  for (const char* moment : {"MX", "MY", "MZ"}) {
    EXPECT_LT(residuals.at(moment).at("peak_nm").get<double>(), 5.0) << moment;
  }
}

TEST_F(SampleOutcome, ActivationsLieBetweenZeroAndOneAndNamesAreTheModels) {
  const TimeSeries& activations = run().result.tables.at("activations");
  EXPECT_GE(activations.columnCount(), 80);
  EXPECT_GE(activations.values.minCoeff(), 0.0);
  EXPECT_LE(activations.values.maxCoeff(), 1.0);
  // Soleus works before toe-off and rests in swing.
  const TimeSeries& cycle = run().result.cycle_tables.at("activations");
  const int soleus = cycle.getColumn("soleus_r");
  EXPECT_GT(cycle.values(55, soleus), 10.0 * cycle.values(85, soleus));
}

TEST_F(SampleOutcome, HoldsTheEmgBesideTheActivations) {
  const TimeSeries& emg = run().result.tables.at("emg");
  EXPECT_EQ(emg.columnCount(), 10);
  EXPECT_TRUE(emg.values.allFinite());
  const Json summary_emg = summary().at("emg");
  EXPECT_EQ(summary_emg.at("processing").at("source"), "envelope");
  EXPECT_EQ(summary_emg.at("activations_of"), "cmc");
  // The envelopes are those of the textbook, the motion is made up: curves of the same shape, the
  // simulated ones some percent later.
  for (const Json& entry : summary_emg.at("comparison")) {
    const std::string channel = entry.at("channel");
    EXPECT_EQ(entry.at("instants"), 100) << channel;
    if (channel == "SOL" || channel == "VL" || channel == "GMED") {
      EXPECT_GT(entry.at("correlation").get<double>(), 0.8) << channel;
      EXPECT_LE(std::abs(entry.at("lag_percent").get<double>()), 15) << channel;
    }
  }
}

}  // namespace
}  // namespace gaitmill

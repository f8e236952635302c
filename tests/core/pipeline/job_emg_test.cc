#include "core/pipeline/job_emg.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/pipeline/settings.h"
#include "tests/support/model_files.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr double kRate = 500;  // [Hz] of the recordings, 5 s long

/// One bell per second: a muscle that is on early in every cycle.
double calcBell(double time) {
  return std::exp(-50 * std::pow(time - std::floor(time) - 0.3, 2));
}

/// Envelopes of two muscles and a channel that nobody knows, from `start` on.
std::string writeEnvelopes(double start) {
  std::string text = "time\tSOL\tL_TA\tBOX 3\n";
  for (int i = 0; i < 5 * kRate; ++i) {
    const double time = start + i / kRate;
    const std::string value = std::to_string(calcBell(time));
    text += std::to_string(time) + "\t" + value + "\t" + value + "\t0\n";
  }
  return text;
}

/// A job whose stages have run: motion 1 to 4 s, cycle 2 to 3 s, soleus as active as its EMG is.
class EmgJob : public ::testing::Test {
 protected:
  EmgJob() {
    job.input = &input;
    job.events = &events;
    job.generic = readOwnModel();
    job.settings.gait_cycle = TimeRange{2, 3};
    std::vector<double> time;
    for (int i = 0; i <= 300; ++i) {
      time.push_back(1 + 0.01 * i);
    }
    job.measured_coordinates = makeTimeSeries("q", {"knee_angle_r"}, time);
    job.motion = job.measured_coordinates;
    TimeSeries activations = makeTimeSeries("activations", {"soleus_r", "tibant_l"}, time);
    for (int i = 0; i <= 300; ++i) {
      activations.values.row(i).setConstant(0.4 * calcBell(time[static_cast<std::size_t>(i)]));
    }
    job.so.emplace();
    job.so->activations = activations;
  }

  void open(const std::string& text, const std::string& settings = "{}") {
    job.settings.emg = readSettings({"", R"({"emg": )" + settings + "}"}).emg;
    input.emg = InputFile{"emg.txt", text};
    openEmg(job);
  }
  nlohmann::ordered_json compared(int index) const {
    return summarizeEmg(job).at("comparison").at(static_cast<std::size_t>(index));
  }

  TrialInput input;
  PipelineEvents events;
  Job job;
};

TEST_F(EmgJob, WithoutEmgHasNone) {
  openEmg(job);
  EXPECT_FALSE(job.emg.has_value());
  StageOutcome outcome;
  addEmg(Stage::kSo, job, outcome);
  EXPECT_TRUE(outcome.tables.empty());
}

TEST_F(EmgJob, SaysWhatWasTakenForWhat) {
  open(writeEnvelopes(0));
  const auto summary = summarizeEmg(job);
  EXPECT_EQ(summary.at("channels").size(), 3U);
  EXPECT_EQ(summary.at("channels")[1].at("side"), "left");
  EXPECT_EQ(summary.at("processing").at("source"), "envelope");
  EXPECT_EQ(summary.at("processing").at("filtered"), false);
  EXPECT_NEAR(summary.at("processing").at("rate_hz").get<double>(), kRate, tol(1e-6));
  EXPECT_EQ(summary.at("electromechanical_delay_s"), 0);
  EXPECT_EQ(summary.at("activations_of"), "so");
  ASSERT_EQ(job.warnings.size(), 1U);
  EXPECT_NE(job.warnings[0].find("'BOX 3'"), std::string::npos);
  // A channel without muscle is shown and not compared.
  EXPECT_EQ(summary.at("comparison").size(), 2U);
}

TEST_F(EmgJob, EqualCurvesAgreeInEveryFigure) {
  open(writeEnvelopes(0));
  const auto soleus = compared(0);
  EXPECT_EQ(soleus.at("instants"), 100);
  EXPECT_EQ(soleus.at("overlap"), 1.0);
  EXPECT_EQ(soleus.at("lag_percent"), 0.0);
  EXPECT_NEAR(soleus.at("correlation").get<double>(), 1.0, tol(1e-6));
  EXPECT_NEAR(soleus.at("scale").get<double>(), 0.4, tol(1e-3));
}

TEST_F(EmgJob, TheDelayMovesTheEmgAndIsReported) {
  open(writeEnvelopes(0), R"({"electromechanical_delay_s": 0.05})");
  EXPECT_EQ(summarizeEmg(job).at("electromechanical_delay_s"), 0.05);
  // The EMG now comes 50 ms, 5 % of the cycle, after the activation.
  EXPECT_EQ(compared(0).at("lag_percent"), -5.0);
  EXPECT_NEAR(compared(0).at("onset_difference_percent").get<double>(), -5.0, tol(0.05));
}

TEST_F(EmgJob, TheTableHasEveryChannelWithinTheMotion) {
  open(writeEnvelopes(0));
  StageOutcome outcome;
  addEmg(Stage::kSo, job, outcome);
  const TimeSeries& table = outcome.tables.at("emg");
  EXPECT_EQ(table.labels, (std::vector<std::string>{"SOL", "L_TA", "BOX 3"}));
  EXPECT_EQ(table.units.size(), 3U);
  EXPECT_NEAR(table.time.front(), 1.0, 2.1e-3);
  EXPECT_NEAR(table.time.back(), 4.0, 2.1e-3);
  const TimeSeries& cycle = outcome.cycle_tables.at("emg");
  EXPECT_EQ(cycle.rowCount(), 101);
  EXPECT_NEAR(cycle.values(30, 0), 1.0, tol(1e-4));
}

TEST_F(EmgJob, RowsOfTheTableAreAMillisecondApart) {
  std::string text = "time\tSOL\n";
  for (int i = 0; i < 8000; ++i) {
    text += std::to_string(1 + i / 4000.0) + "\t1\n";
  }
  open(text);
  StageOutcome outcome;
  addEmg(Stage::kIk, job, outcome);
  const TimeSeries& table = outcome.tables.at("emg");
  EXPECT_NEAR(table.time[1] - table.time[0], 1e-3, tol(1e-6));
}

TEST_F(EmgJob, ARecordingOfAnotherTimeIsAWarning) {
  open(writeEnvelopes(100));
  warnOfEmg(Stage::kSo, job);
  ASSERT_EQ(job.warnings.size(), 2U);
  EXPECT_NE(job.warnings[1].find("does not cover"), std::string::npos);
  EXPECT_EQ(compared(0).at("instants"), 0);
  EXPECT_TRUE(compared(0).at("overlap").is_null());
  StageOutcome outcome;
  addEmg(Stage::kSo, job, outcome);
  EXPECT_TRUE(outcome.tables.empty());
}

TEST_F(EmgJob, WithoutCycleNothingIsCompared) {
  job.settings.gait_cycle.reset();
  open(writeEnvelopes(0));
  warnOfEmg(Stage::kSo, job);
  EXPECT_EQ(job.warnings.size(), 2U);
  EXPECT_TRUE(summarizeEmg(job).at("comparison").empty());
  StageOutcome outcome;
  addEmg(Stage::kSo, job, outcome);
  EXPECT_EQ(outcome.tables.count("emg"), 1U);
  EXPECT_EQ(outcome.cycle_tables.count("emg"), 0U);
}

TEST_F(EmgJob, WhatCannotBeFilteredIsLeftOutWithAWarning) {
  std::string slow = "time\tSOL\n";
  for (int i = 0; i < 100; ++i) {
    slow += std::to_string(0.02 * i) + "\t1\n";
  }
  open(slow, R"({"source": "raw"})");
  EXPECT_FALSE(job.emg.has_value());
  ASSERT_EQ(job.warnings.size(), 1U);
  EXPECT_NE(job.warnings[0].find("left out"), std::string::npos);
}

TEST_F(EmgJob, AFileThatIsNoRecordingIsRefused) {
  EXPECT_THROW(open("File_Type:\tnothing else\n"), Error);
}

}  // namespace
}  // namespace gaitmill

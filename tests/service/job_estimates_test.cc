#include "service/job_estimates.h"

#include <gtest/gtest.h>

namespace gaitmill {
namespace {

const std::vector<StageEstimate> kMeans = {
    {"scale", 1, 0}, {"ik", 2, 0}, {"rra", 4, 0}, {"id", 1, 0}, {"so", 8, 0}, {"cmc", 16, 0}};

api::JobView makeJob(api::JobState state, std::vector<api::StageTiming> stages) {
  api::JobView job;
  job.state = state;
  job.stages = std::move(stages);
  job.settings_json = "{}";
  return job;
}

TEST(JobEstimates, QueuedJobTakesAllItsStagesAfterTheJobsAhead) {
  api::JobView job = makeJob(api::JobState::kQueued, {});
  EXPECT_EQ(calcSecondsLeft(job, kMeans, 2), 32.0);
  job.jobs_ahead = 3;
  EXPECT_EQ(calcSecondsLeft(job, kMeans, 2), 32.0 + 3 * 32.0 / 2);
}

TEST(JobEstimates, OwnPaceReplacesTheMeanOfTheStageUnderWay) {
  const api::JobView job =
      makeJob(api::JobState::kRunning, {{"scale", 1, 1.0}, {"ik", 3, 1.0}, {"rra", 10, 0.25}});
  EXPECT_EQ(calcSecondsLeft(job, kMeans, 1), 30.0 + 1 + 8 + 16);
}

TEST(JobEstimates, StageThatHasHardlyBegunTakesTheMean) {
  const api::JobView job = makeJob(api::JobState::kRunning, {{"scale", 0.25, 0.01}});
  EXPECT_EQ(calcSecondsLeft(job, kMeans, 1), 0.75 + 31);
}

TEST(JobEstimates, OnlyTheStagesThatTheSettingsAskForCount) {
  api::JobView job = makeJob(api::JobState::kQueued, {});
  job.settings_json = R"({"stages": {"first": "ik", "last": "id"}})";
  EXPECT_EQ(calcSecondsLeft(job, kMeans, 1), 2.0 + 4 + 1);
}

TEST(JobEstimates, NothingIsSaidWhereNothingIsKnown) {
  EXPECT_EQ(calcSecondsLeft(makeJob(api::JobState::kQueued, {}), {}, 1), std::nullopt);
  EXPECT_EQ(calcSecondsLeft(makeJob(api::JobState::kSucceeded, {}), kMeans, 1), std::nullopt);
}

TEST(JobEstimates, TheFirstJobOfAllIsEstimatedByItsLastStage) {
  api::JobView job = makeJob(api::JobState::kRunning, {{"ik", 5, 0.5}});
  job.settings_json = R"({"stages": {"first": "ik", "last": "ik"}})";
  EXPECT_EQ(calcSecondsLeft(job, {}, 1), 5.0);
}

TEST(JobEstimates, MeansAreAskedOnceInAWhile) {
  int asked = 0;
  JobEstimates estimates(
      [&asked] {
        ++asked;
        return kMeans;
      },
      1,
      std::chrono::hours(1));
  const api::JobView job = makeJob(api::JobState::kQueued, {});
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(estimates.calcSecondsLeft(job), 32.0);
  }
  EXPECT_EQ(asked, 1);
}

}  // namespace
}  // namespace gaitmill

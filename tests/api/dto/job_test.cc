#include "api/dto/job.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "tests/support/tolerance.h"

namespace gaitmill::api {
namespace {

TEST(JobState, NamesComeBack) {
  for (const char* name : {"queued", "running", "succeeded", "failed", "cancelled"}) {
    EXPECT_STREQ(jobStateName(findJobState(name)), name);
  }
  EXPECT_THROW(findJobState("dead"), Error);
}

TEST(CalcJobProgress, GrowsThroughTheStagesToOne) {
  JobView job;
  job.state = JobState::kRunning;
  EXPECT_EQ(calcJobProgress(job), 0.0);
  double last = 0.0;
  for (const char* stage : {"scale", "ik", "rra", "id", "so", "cmc"}) {
    for (const double fraction : {0.0, 0.5, 1.0}) {
      if (fraction == 0.0) {
        job.stages.push_back({stage, 0.0, 0.0});
      }
      job.stages.back().fraction = fraction;
      EXPECT_GE(calcJobProgress(job), last) << stage;
      last = calcJobProgress(job);
    }
  }
  EXPECT_NEAR(last, 1.0, tol(1e-12));
}

TEST(RenderJob, NamesTheStageOnlyWhileRunning) {
  JobView job;
  job.stages = {{"scale", 1.0, 1.0}, {"ik", 2.0, 0.5}};
  job.state = JobState::kRunning;
  EXPECT_EQ(nlohmann::json::parse(renderJob(job))["stage"], "ik");
  job.state = JobState::kFailed;
  job.error = R"({"code": "ik.x"})";
  EXPECT_EQ(nlohmann::json::parse(renderJob(job))["stage"], nullptr);
  EXPECT_EQ(nlohmann::json::parse(renderJob(job))["error"]["code"], "ik.x");
}

TEST(RenderJob, CountsTheQueueFromOne) {
  JobView job;
  EXPECT_EQ(nlohmann::json::parse(renderJob(job))["queue_position"], nullptr);
  job.jobs_ahead = 0;
  EXPECT_EQ(nlohmann::json::parse(renderJob(job))["queue_position"], 1);
}

TEST(ParseJobRequest, RefusesWhatIsNotAJob) {
  for (const char* text : {"{}",
                           R"({"trial": 3})",
                           R"({"trial": ""})",
                           R"({"trial": "t", "settings": 3})",
                           R"({"trial": "t", "settings": []})",
                           R"({"trial": "t", "settings": ""})",
                           R"({"trial": "t", "label": 3})",
                           R"({"trial": "t", "modle": "m"})"}) {
    try {
      parseJobRequest(text);
      FAIL() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kRequestField) << text;
    }
  }
}

}  // namespace
}  // namespace gaitmill::api

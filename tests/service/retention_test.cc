#include "service/retention.h"

#include <gtest/gtest.h>

#include "service/storage/clock.h"
#include "tests/service/expect_error.h"
#include "tests/service/port_fixture.h"

namespace gaitmill {
namespace {

constexpr std::int64_t kDay = 24LL * 3'600 * 1'000;  // [ms]

class RetentionTest : public ::testing::Test {
 protected:
  Retention::Removed removeAfterDays(int keep_days, int days) {
    return Retention(fixture_.stores(), keep_days).removeOld(nowMilliseconds() + days * kDay);
  }

  PortFixture fixture_;
  const api::Identity who_ = makeMember("gait lab");
};

TEST_F(RetentionTest, OldJobsAndTheirTrialsGo) {
  const std::string job = fixture_.addFinishedJob(who_);
  const std::string trial = fixture_.ports().jobs.find(who_, job).trial_id;
  EXPECT_EQ(removeAfterDays(30, 29).jobs, 0);
  const Retention::Removed removed = removeAfterDays(30, 31);
  EXPECT_EQ(removed.jobs, 1);
  EXPECT_EQ(removed.trials, 1);
  EXPECT_ERROR(fixture_.ports().jobs.find(who_, job), ErrorCode::kJobNotFound);
  EXPECT_ERROR(fixture_.ports().trials.find(who_, trial), ErrorCode::kTrialNotFound);
}

TEST_F(RetentionTest, JobsThatHaveNotEndedStayWithTheirTrials) {
  const std::string trial = fixture_.addTrial(who_);
  const std::string job = fixture_.addJob(who_, trial);
  EXPECT_EQ(removeAfterDays(1, 100).jobs, 0);
  EXPECT_EQ(fixture_.ports().jobs.find(who_, job).state, api::JobState::kQueued);
  EXPECT_EQ(fixture_.ports().trials.find(who_, trial).id, trial);
}

TEST_F(RetentionTest, StudyGoesWithItsLastJob) {
  api::StudyRequest request;
  api::JobRequest job;
  job.trial_id = fixture_.addTrial(who_);
  job.settings_json = "{}";
  request.jobs = {job, job};
  const std::string study = fixture_.ports().studies.submit(who_, request).id;
  fixture_.runNextJob();
  removeAfterDays(1, 100);
  EXPECT_EQ(fixture_.ports().studies.find(who_, study).job_ids.size(), 1U);
  fixture_.runNextJob();
  EXPECT_EQ(removeAfterDays(1, 100).studies, 1);
  EXPECT_ERROR(fixture_.ports().studies.find(who_, study), ErrorCode::kStudyNotFound);
}

TEST_F(RetentionTest, ZeroDaysKeepForEver) {
  fixture_.addFinishedJob(who_);
  EXPECT_EQ(removeAfterDays(0, 10'000).jobs, 0);
  EXPECT_EQ(fixture_.ports().jobs.list(who_, {}, {}).items.size(), 1U);
}

TEST_F(RetentionTest, MoreThanOneBatchGoesAtOnce) {
  const std::string trial = fixture_.addTrial(who_);
  for (int i = 0; i < 230; ++i) {
    fixture_.ports().jobs.cancel(who_, fixture_.addJob(who_, trial));
  }
  EXPECT_EQ(removeAfterDays(1, 2).jobs, 230);
}

TEST_F(RetentionTest, ItsThreadStartsAndStops) {
  Retention retention(fixture_.stores(), 30);
  retention.start();
  retention.stop();
}

}  // namespace
}  // namespace gaitmill

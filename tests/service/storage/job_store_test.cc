#include "service/storage/job_store.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "service/storage/key_store.h"
#include "tests/service/storage/storage_fixture.h"

namespace gaitmill {
namespace {

using State = api::JobState;
using JobStoreTest = StorageTest;

TEST_F(JobStoreTest, FindsWhatWasSubmitted) {
  NewTrial trial = makeTrial({});
  trial.subject.subject = "S01";
  NewJob job = makeJob(trials_.add(trial).id);
  job.label = "first";
  job.model_id = "rajagopal2016";
  const api::JobView view = find(jobs_.submit(job));
  EXPECT_EQ(view.trial_id, job.trial_id);
  EXPECT_EQ(view.subject, "S01");
  EXPECT_EQ(view.label, "first");
  EXPECT_EQ(view.model_id, "rajagopal2016");
  EXPECT_EQ(view.settings_name, "default");
  EXPECT_EQ(view.settings_json, R"({"a":1})");
  EXPECT_EQ(view.provenance, "abc");
  EXPECT_EQ(view.state, State::kQueued);
  EXPECT_EQ(view.version, 1);
  EXPECT_EQ(view.attempt, 0);
  EXPECT_GT(view.submitted_at, 0);
  EXPECT_FALSE(view.started_at || view.finished_at || view.error);
  EXPECT_EQ(view.jobs_ahead, 0);
}

TEST_F(JobStoreTest, UnknownTrialModelAndJobAreNamed) {
  EXPECT_EQ(codeOf([&] { jobs_.submit(makeJob("tri_none")); }), ErrorCode::kTrialNotFound);
  EXPECT_EQ(codeOf([&] { jobs_.submit(makeJob(trial_, "lab_b")); }), ErrorCode::kTrialNotFound);
  NewJob job = makeJob(trial_);
  job.model_id = "mod_01hf3v6k9e2m8xw7p0q4t5r6s1";
  EXPECT_EQ(codeOf([&] { jobs_.submit(job); }), ErrorCode::kModelNotFound);
}

TEST_F(JobStoreTest, AnotherTenantsJobDoesNotExist) {
  const std::string id = submit();
  const auto expect_absent = [](auto call) {
    EXPECT_EQ(codeOf(call), ErrorCode::kJobNotFound);
  };
  for (const std::string& other : {std::string("job_none"), id}) {
    expect_absent([&] { jobs_.find("lab_b", other); });
    expect_absent([&] { jobs_.requestCancel("lab_b", other); });
    expect_absent([&] { jobs_.remove("lab_b", other); });
    expect_absent([&] { jobs_.listEvents("lab_b", other, 0); });
    expect_absent([&] { jobs_.listResults("lab_b", other); });
    expect_absent([&] { jobs_.listFiles("lab_b", other); });
    expect_absent([&] { jobs_.readFile("lab_b", other, "x"); });
    expect_absent([&] { jobs_.readResult("lab_b", other, ResultKind::kTime, "x"); });
  }
  EXPECT_TRUE(jobs_.list("lab_b", {}, {}).items.empty());
}

TEST_F(JobStoreTest, ListsNewestFirstByEveryFilter) {
  std::vector<std::string> ids;
  for (int i = 0; i < 6; ++i) {
    NewJob job = makeJob(trial_);
    job.label = i < 2 ? "early" : "late";
    ids.push_back(jobs_.submit(job));
  }
  claim();
  const auto page = jobs_.list(kTenant, {}, {"", 4});
  ASSERT_EQ(page.items.size(), 4U);
  EXPECT_EQ(page.items[0].id, ids[5]);
  EXPECT_EQ(page.items[0].jobs_ahead, 4);
  EXPECT_EQ(page.items[0].settings_json, "");
  EXPECT_EQ(jobs_.list(kTenant, {}, {page.next_cursor, 4}).items.size(), 2U);
  const auto count = [this](const api::ListFilter& filter) {
    return jobs_.list(kTenant, filter, {"", 200}).items.size();
  };
  api::ListFilter filter;
  filter.label = "late";
  EXPECT_EQ(count(filter), 4U);
  filter.state = "running";
  EXPECT_EQ(count(filter), 0U);
  filter.label = "early";
  EXPECT_EQ(count(filter), 1U);
  filter.trial_id = trial_;
  EXPECT_EQ(count(filter), 1U);
  filter.trial_id = "tri_other";
  EXPECT_EQ(count(filter), 0U);
  filter = {};
  filter.state = "lost";
  EXPECT_EQ(codeOf([&] { count(filter); }), ErrorCode::kRequestField);
  EXPECT_EQ(codeOf([&] { jobs_.list(kTenant, {}, {"tri_1", 5}); }), ErrorCode::kRequestField);
}

TEST_F(JobStoreTest, CancelEndsQueuedJobsAndMarksRunningOnes) {
  const std::string running = submit();
  const std::string queued = submit();
  const JobTicket ticket = claim();
  jobs_.requestCancel(kTenant, queued);
  EXPECT_EQ(stateOf(queued), State::kCancelled);
  jobs_.requestCancel(kTenant, running);
  EXPECT_EQ(stateOf(running), State::kRunning);
  EXPECT_TRUE(find(running).cancel_requested);
  EXPECT_TRUE(jobs_.findStanding(ticket).cancel_requested);
  EXPECT_TRUE(jobs_.heartbeat(ticket, kLease).cancel_requested);
  EXPECT_TRUE(jobs_.cancelRunning(ticket));
  jobs_.requestCancel(kTenant, running);
  EXPECT_EQ(stateOf(running), State::kCancelled);
}

TEST_F(JobStoreTest, CancelEndsARunningJobThatNobodyHolds) {
  const std::string id = submit();
  EXPECT_TRUE(jobs_.giveBack(claim()));
  jobs_.requestCancel(kTenant, id);
  EXPECT_EQ(stateOf(id), State::kCancelled);
  EXPECT_FALSE(jobs_.claimNext("serve:1", kLease).has_value());
}

TEST_F(JobStoreTest, FinishedJobCannotBeCancelled) {
  const std::string id = submit();
  jobs_.fail(claim(), Error(ErrorCode::kInputMarkers, "no markers", {"walk.trc", 3}));
  EXPECT_EQ(codeOf([&] { jobs_.requestCancel(kTenant, id); }), ErrorCode::kJobState);
  const auto error = nlohmann::json::parse(find(id).error.value());
  EXPECT_EQ(error["code"], "input.markers");
  EXPECT_EQ(error["where"]["line"], 3);
}

TEST_F(JobStoreTest, OnlyFinalJobsAreRemoved) {
  const std::string id = submit();
  EXPECT_EQ(codeOf([&] { jobs_.remove(kTenant, id); }), ErrorCode::kJobState);
  const JobTicket ticket = claim();
  EXPECT_EQ(codeOf([&] { jobs_.remove(kTenant, id); }), ErrorCode::kJobState);
  jobs_.succeed(ticket, {{ResultKind::kFile, "ik.mot", "bytes", "ik"}}, "pass");
  jobs_.remove(kTenant, id);
  EXPECT_EQ(codeOf([&] { find(id); }), ErrorCode::kJobNotFound);
  for (const char* sql : {"SELECT count(*) FROM results",
                          "SELECT count(*) FROM job_events",
                          "SELECT count(*) FROM job_settings"}) {
    EXPECT_EQ(queryInteger(database_, sql), 0) << sql;
  }
  EXPECT_NO_THROW(trials_.remove(kTenant, trial_));
}

TEST_F(JobStoreTest, EventsTellTheWholeLifeInOrder) {
  const std::string id = submit();
  const JobTicket ticket = claim();
  jobs_.saveProgress(ticket, {{"ik", 0.1, 0.0}}, {});
  jobs_.saveProgress(ticket, {{"ik", 0.2, 0.3}}, {"careful"});
  jobs_.saveProgress(ticket, {{"ik", 0.3, 0.6}}, {});
  jobs_.saveProgress(ticket, {{"ik", 0.3, 0.6}}, {});
  jobs_.saveStage(ticket, {"ik", "checkpoint", {}, {{"ik", 1.0, 1.0}}, {}});
  jobs_.succeed(ticket, {}, "pass");
  const auto events = jobs_.listEvents(kTenant, id, 0);
  std::vector<std::string> told;
  for (const api::JobEvent& event : events) {
    told.push_back(event.kind + " " + event.data);
  }
  const std::vector<std::string> expected = {
      R"(state {"state":"queued"})",
      R"(state {"attempt":1,"state":"running"})",
      R"(stage {"seconds":0.1,"stage":"ik","status":"started"})",
      R"(warning {"message":"careful"})",
      R"(stage {"seconds":1.0,"stage":"ik","status":"finished"})",
      R"(state {"state":"succeeded"})"};
  EXPECT_EQ(told, expected) << "progress is told only as long as it is the news";
  EXPECT_EQ(events.back().id, find(id).version);
  EXPECT_EQ(jobs_.listEvents(kTenant, id, events[3].id).size(), 2U);
  EXPECT_EQ(jobs_.listEvents(kTenant, id, 0, 2).size(), 2U);
}

TEST_F(JobStoreTest, VersionGrowsWithWhatTheUserSeesAndNothingElse) {
  const std::string id = submit();
  const JobTicket ticket = claim();
  const std::int64_t claimed = find(id).version;
  jobs_.heartbeat(ticket, kLease);
  EXPECT_EQ(find(id).version, claimed);
  jobs_.saveProgress(ticket, {{"ik", 0.1, 0.5}}, {});
  const std::int64_t progressed = find(id).version;
  EXPECT_GT(progressed, claimed);
  jobs_.saveProgress(ticket, {{"ik", 0.1, 0.5}}, {});
  EXPECT_EQ(find(id).version, progressed);
  jobs_.requestCancel(kTenant, id);
  EXPECT_GT(find(id).version, progressed);
}

TEST_F(JobStoreTest, ListenersAndOtherProcessesHearOfEveryChange) {
  std::vector<std::string> heard;
  jobs_.setListener([&heard](const JobChange& change) { heard.push_back(change.job_id); });
  const std::int64_t before = jobs_.lastChange();
  const std::string first = submit();
  const std::string second = submit();
  claim();
  EXPECT_EQ(heard, (std::vector<std::string>{first, second, first}));
  Database other({folder_ / "mill.db", DatabaseUse::kWork});
  JobStore elsewhere(other);
  EXPECT_EQ(elsewhere.lastChange(), before + 3);
  const auto changes = elsewhere.listChanges(before);
  ASSERT_EQ(changes.size(), 2U) << "each job once, at its last change";
  EXPECT_EQ(changes[0].job_id, second);
  EXPECT_EQ(changes[1].job_id, first);
  EXPECT_TRUE(elsewhere.listChanges(changes[1].change).empty());
}

TEST_F(JobStoreTest, SubmissionRepeatedUnderItsKeyIsOneJob) {
  NewJob job = makeJob(trial_);
  job.submission_key = "k1";
  const std::string id = jobs_.submit(job);
  EXPECT_EQ(jobs_.submit(job), id);
  job.submission_key = "k2";
  EXPECT_NE(jobs_.submit(job), id);
}

TEST_F(JobStoreTest, QuotasOfAKeyHold) {
  NewJob job = makeJob(trial_);
  job.key_id = "key_1";
  job.frames = 100;
  job.pixels = 1000;
  const std::string id = jobs_.submit(job, {0, 2, 250, 5000});
  jobs_.submit(job, {0, 2, 250, 5000});
  EXPECT_EQ(codeOf([&] { jobs_.submit(job, {0, 2, 0, 0}); }), ErrorCode::kQuotaExceeded);
  EXPECT_EQ(codeOf([&] { jobs_.submit(job, {0, 0, 250, 0}); }), ErrorCode::kQuotaExceeded);
  EXPECT_EQ(codeOf([&] { jobs_.submit(job, {0, 0, 0, 2500}); }), ErrorCode::kQuotaExceeded);
  const Usage usage = KeyStore(database_).findUsage(kTenant, "key_1");
  EXPECT_EQ(usage.jobs, 2);
  EXPECT_EQ(usage.frames, 200);
  EXPECT_EQ(usage.pixels, 2000);
  jobs_.requestCancel(kTenant, id);
  jobs_.remove(kTenant, id);
  EXPECT_NO_THROW(jobs_.submit(job, {0, 2, 250, 5000}));
}

TEST_F(JobStoreTest, StatisticsCountTheQueue) {
  EXPECT_FALSE(jobs_.calcStatistics().oldest_queued_at.has_value());
  const std::string first = submit();
  submit();
  submit();
  jobs_.fail(claim(), Error(ErrorCode::kInternal, ""));
  jobs_.giveBack(claim());
  const QueueStatistics statistics = jobs_.calcStatistics();
  EXPECT_EQ(statistics.jobs.at("failed"), 1);
  EXPECT_EQ(statistics.jobs.at("running"), 1);
  EXPECT_EQ(statistics.jobs.at("queued"), 1);
  EXPECT_EQ(statistics.jobs.at("cancelled"), 0);
  EXPECT_EQ(statistics.depth, 2) << "the given-back one waits, too";
  EXPECT_GE(statistics.oldest_queued_at.value(), find(first).submitted_at);
}

TEST_F(JobStoreTest, StagesAreEstimatedFromJobsThatSucceeded) {
  NewJob job = makeJob(trial_);
  job.frames = 100;
  for (const double seconds : {1.0, 3.0}) {
    jobs_.submit(job);
    const JobTicket ticket = claim();
    jobs_.saveProgress(ticket, {{"scale", 0.5, 1.0}, {"ik", seconds, 1.0}}, {});
    jobs_.succeed(ticket, {}, "pass");
  }
  const auto estimates = jobs_.calcStageEstimates();
  ASSERT_EQ(estimates.size(), 2U);
  EXPECT_EQ(estimates[0].stage, "scale");
  EXPECT_EQ(estimates[1].stage, "ik");
  EXPECT_DOUBLE_EQ(estimates[1].seconds, 2.0);
  EXPECT_DOUBLE_EQ(estimates[1].seconds_per_frame, 0.02);
}

TEST_F(JobStoreTest, FinishedOnesAreListedForRetention) {
  const std::string id = submit();
  submit();
  jobs_.succeed(claim(), {}, "pass");
  const std::int64_t ended = find(id).finished_at.value();
  EXPECT_TRUE(jobs_.listFinished(ended, 10).empty());
  const auto finished = jobs_.listFinished(ended + 1, 10);
  ASSERT_EQ(finished.size(), 1U);
  EXPECT_EQ(finished[0].id, id);
  EXPECT_EQ(finished[0].tenant, kTenant);
}

}  // namespace
}  // namespace gaitmill

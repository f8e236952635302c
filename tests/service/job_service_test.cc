#include "service/job_service.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "service/job_input.h"
#include "tests/service/expect_error.h"
#include "tests/service/port_fixture.h"

namespace gaitmill {
namespace {

using nlohmann::json;

class JobServiceTest : public ::testing::Test {
 protected:
  api::JobPort& jobs() { return fixture_.ports().jobs; }
  api::JobView submit(const std::string& trial, const std::string& settings) {
    api::JobRequest request;
    request.trial_id = trial;
    request.settings_json = settings;
    return jobs().submit(who_, request);
  }

  PortFixture fixture_;
  const api::Identity who_ = makeMember("gait lab");
};

TEST_F(JobServiceTest, SettingsAreComposedOnceAndForAll) {
  api::TrialUpload upload = makeUpload("abc");
  upload.subject.marker_set = "lab_b";
  upload.subject.options = R"({"steps": 7, "ik": {"a": 1}})";
  const std::string trial = fixture_.ports().trials.submit(who_, upload).id;
  const json own = json::parse(submit(trial, R"({"ik": {"b": 2}, "steps": 9})").settings_json);
  EXPECT_EQ(own["steps"], 9) << "the job's document wins";
  EXPECT_EQ(own["ik"], (json{{"a", 1}, {"b", 2}}));
  EXPECT_EQ(own["scale"]["marker_set"], "lab_b");
  api::JobRequest named;
  named.trial_id = trial;
  named.settings_name = "slow";
  EXPECT_EQ(json::parse(jobs().submit(who_, named).settings_json)["steps"], 7)
      << "the trial's options win over a name";
}

TEST_F(JobServiceTest, WhatCannotRunIsRefusedAtSubmission) {
  const std::string trial = fixture_.addTrial(who_);
  EXPECT_ERROR(submit(trial, R"({"nonsense": 1})"), ErrorCode::kSettingsUnknownField);
  EXPECT_ERROR(submit("tri_00000000000000000000000000", "{}"), ErrorCode::kTrialNotFound);
  EXPECT_ERROR(submit(trial, R"({"scale": {"marker_set": "mks_00000000000000000000000000"}})"),
               ErrorCode::kMarkerSetNotFound);
  api::JobRequest request;
  request.trial_id = trial;
  request.settings_name = "absent";
  EXPECT_ERROR(jobs().submit(who_, request), ErrorCode::kSettingsValue);
  request.settings_name = "default";
  request.model_id = "mod_00000000000000000000000000";
  EXPECT_ERROR(jobs().submit(who_, request), ErrorCode::kModelNotFound);
  request.model_id = "atlas";
  EXPECT_ERROR(jobs().submit(who_, request), ErrorCode::kModelNotFound);
  api::TrialUpload empty;
  empty.subject = makeUpload("").subject;
  request.model_id.clear();
  request.trial_id = fixture_.ports().trials.submit(who_, empty).id;
  EXPECT_ERROR(jobs().submit(who_, request), ErrorCode::kInputMissing);
  EXPECT_TRUE(jobs().list(who_, {}, {}).items.empty());
  EXPECT_EQ(fixture_.woken, 0);
}

TEST_F(JobServiceTest, ProvenanceIsThatOfTheWorkAndNotOfTheTrialsId) {
  const std::string first = submit(fixture_.addTrial(who_), "{}").provenance;
  EXPECT_EQ(first.size(), 64U);
  EXPECT_EQ(submit(fixture_.addTrial(who_), "{}").provenance, first);
  EXPECT_EQ(submit(fixture_.addTrial(makeMember("gait lab")), "{}").provenance, first);
  EXPECT_NE(submit(fixture_.addTrial(who_), R"({"steps": 3})").provenance, first);
  EXPECT_NE(submit(fixture_.addTrial(who_, "other bytes"), "{}").provenance, first);
}

TEST_F(JobServiceTest, NamedModelAndMarkerSetReachThePipelineAndTheProvenance) {
  const std::string model = fixture_.ports().models.add(who_, "mine", R"({"markers": [1]})").id;
  const std::string set = fixture_.ports().marker_sets.add(who_, "m", R"({"markers": ["A"]})").id;
  const std::string trial = fixture_.addTrial(who_);
  const std::string plain = submit(trial, "{}").provenance;
  api::JobRequest request;
  request.trial_id = trial;
  request.model_id = model;
  request.settings_json = json{{"scale", {{"marker_set", set}}}}.dump();
  const api::JobView job = jobs().submit(who_, request);
  EXPECT_NE(job.provenance, plain);
  ClaimedJob claimed;
  claimed.tenant = who_.tenant;
  claimed.trial_id = trial;
  claimed.model_id = job.model_id;
  claimed.settings_json = job.settings_json;
  const JobInput input = readJobInput(fixture_.stores(), fixture_.services().shipped(), claimed);
  EXPECT_EQ(readSource(*input.parts.at("model").bytes), R"({"markers": [1]})");
  EXPECT_EQ(readSource(*input.parts.at("marker_set").bytes), R"({"markers": ["A"]})");
  EXPECT_EQ(readSource(*input.parts.at("markers").bytes), "the bytes");
}

TEST_F(JobServiceTest, WorkersAreToldOfNewAndOfCancelledJobs) {
  const std::string trial = fixture_.addTrial(who_);
  const std::string id = fixture_.addJob(who_, trial);
  EXPECT_EQ(fixture_.woken, 1);
  EXPECT_EQ(jobs().cancel(who_, id).state, api::JobState::kCancelled);
  EXPECT_EQ(fixture_.cancelled, std::vector<std::string>{id});
}

TEST_F(JobServiceTest, TimeLeftIsToldOnceJobsHaveSucceeded) {
  const std::string trial = fixture_.addTrial(who_);
  EXPECT_EQ(submit(trial, "{}").seconds_left, std::nullopt);
  fixture_.runNextJob();
  fixture_.reopen();
  EXPECT_EQ(submit(trial, "{}").seconds_left, 6.0) << "six stages of one second each";
}

TEST_F(JobServiceTest, RepeatedSubmissionIsTheSameJobAlsoAfterARestart) {
  api::JobRequest request;
  request.trial_id = fixture_.addTrial(who_);
  request.settings_json = "{}";
  request.submission_key = "monday";
  const std::string id = jobs().submit(who_, request).id;
  fixture_.reopen();
  EXPECT_EQ(jobs().submit(who_, request).id, id);
  EXPECT_EQ(jobs().list(who_, {}, {}).items.size(), 1U);
}

TEST(JobServiceQuota, JobsAndFramesBeyondTheQuotaAreRefused) {
  Quota quota;
  quota.frames = 5;  // a trial has three
  PortFixture fixture(quota);
  const api::Identity who = makeMember("gait lab", "key_1");
  const std::string trial = fixture.addTrial(who);
  const std::string id = fixture.addJob(who, trial);
  EXPECT_ERROR(fixture.addJob(who, trial), ErrorCode::kQuotaExceeded);
  fixture.runNextJob();
  fixture.ports().jobs.remove(who, id);
  fixture.addJob(who, trial);
}

}  // namespace
}  // namespace gaitmill

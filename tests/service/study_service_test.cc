#include "service/study_service.h"

#include <set>

#include <gtest/gtest.h>

#include "tests/service/expect_error.h"
#include "tests/service/port_fixture.h"

namespace gaitmill {
namespace {

class StudyServiceTest : public ::testing::Test {
 protected:
  api::StudyPort& studies() { return fixture_.ports().studies; }
  // Two trials times two settings.
  api::StudyRequest makeRequest() {
    api::StudyRequest request;
    request.name = "shoes";
    request.label = "pilot";
    for (const std::string& trial :
         {fixture_.addTrial(who_, "barefoot"), fixture_.addTrial(who_)}) {
      for (const char* settings : {R"({"steps": 1})", R"({"steps": 2})"}) {
        api::JobRequest job;
        job.trial_id = trial;
        job.settings_json = settings;
        request.jobs.push_back(job);
      }
    }
    return request;
  }

  PortFixture fixture_;
  const api::Identity who_ = makeMember("gait lab");
};

TEST_F(StudyServiceTest, TrialsTimesSettingsRunAndGiveATable) {
  const std::string id = studies().submit(who_, makeRequest()).id;
  EXPECT_EQ(studies().find(who_, id).job_ids.size(), 4U);
  EXPECT_EQ(studies().find(who_, id).jobs.at("queued"), 4);
  for (int i = 0; i < 4; ++i) {
    fixture_.runNextJob();
  }
  const api::StudyView study = studies().find(who_, id);
  EXPECT_EQ(study.jobs.at("succeeded"), 4);
  EXPECT_EQ(study.progress, 1.0);
  std::set<std::string> provenances;
  for (const api::StudyRow& row : studies().listRows(who_, id)) {
    EXPECT_EQ(row.job.study_id, id);
    EXPECT_NE(row.quality_json.find("0.25"), std::string::npos);
    provenances.insert(row.job.provenance);
  }
  EXPECT_EQ(provenances.size(), 4U);
}

TEST_F(StudyServiceTest, OneJobThatCannotRunKeepsAllOut) {
  api::StudyRequest request = makeRequest();
  request.jobs.back().settings_json = R"({"nonsense": 1})";
  EXPECT_ERROR(studies().submit(who_, request), ErrorCode::kSettingsUnknownField);
  EXPECT_TRUE(studies().list(who_, {}, {}).items.empty());
  EXPECT_TRUE(fixture_.ports().jobs.list(who_, {}, {}).items.empty());
}

TEST_F(StudyServiceTest, StudyWithoutJobsOrWithTooManyIsRefused) {
  api::StudyRequest request;
  EXPECT_ERROR(studies().submit(who_, request), ErrorCode::kRequestField);
  request.jobs.resize(StudyService::kMaxJobs + 1);
  EXPECT_ERROR(studies().submit(who_, request), ErrorCode::kRequestField);
}

TEST_F(StudyServiceTest, CancelledStudyTellsTheWorkersOfItsRunningJobs) {
  const std::string id = studies().submit(who_, makeRequest()).id;
  const std::string running = fixture_.runNextJob("ik").job_id;
  const api::StudyView study = studies().cancel(who_, id);
  EXPECT_EQ(study.jobs.at("cancelled"), 3);
  EXPECT_EQ(fixture_.cancelled, std::vector<std::string>{running});
}

TEST_F(StudyServiceTest, RemovedStudyTakesItsJobsAlong) {
  const std::string id = studies().submit(who_, makeRequest()).id;
  EXPECT_ERROR(studies().remove(who_, id), ErrorCode::kJobState);
  studies().cancel(who_, id);
  studies().remove(who_, id);
  EXPECT_ERROR(studies().find(who_, id), ErrorCode::kStudyNotFound);
  EXPECT_TRUE(fixture_.ports().jobs.list(who_, {}, {}).items.empty());
}

TEST_F(StudyServiceTest, RepeatedSubmissionIsTheSameStudy) {
  api::StudyRequest request = makeRequest();
  request.submission_key = "monday";
  const std::string id = studies().submit(who_, request).id;
  EXPECT_EQ(studies().submit(who_, request).id, id);
  EXPECT_EQ(fixture_.ports().jobs.list(who_, {}, {}).items.size(), 4U);
}

}  // namespace
}  // namespace gaitmill

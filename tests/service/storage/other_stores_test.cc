// The small stores: studies, catalogs, keys, kept answers.

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "service/storage/catalog_store.h"
#include "service/storage/idempotency_store.h"
#include "service/storage/key_store.h"
#include "service/storage/study_store.h"
#include "tests/service/storage/storage_fixture.h"

namespace gaitmill {
namespace {

class StudyStoreTest : public StorageTest {
 protected:
  NewStudy makeStudy(int jobs) {
    NewStudy study;
    study.tenant = kTenant;
    study.name = "walkers";
    study.label = "2026";
    study.jobs.assign(static_cast<std::size_t>(jobs), makeJob(trial_));
    return study;
  }

  StudyStore studies_{database_, jobs_};
};

TEST_F(StudyStoreTest, HasItsOwnProgressAndTable) {
  const std::string id = studies_.submit(makeStudy(3));
  const api::StudyView fresh = studies_.find(kTenant, id);
  EXPECT_EQ(fresh.name, "walkers");
  EXPECT_EQ(fresh.jobs.at("queued"), 3);
  EXPECT_EQ(fresh.jobs.at("failed"), 0);
  EXPECT_EQ(fresh.progress, 0.0);
  EXPECT_EQ(fresh.job_ids.size(), 3U);
  jobs_.succeed(claim(), {{ResultKind::kSummary, "quality", R"({"q":1})", ""}}, "pass");
  const api::StudyView later = studies_.find(kTenant, id);
  EXPECT_GT(later.version, fresh.version);
  EXPECT_NEAR(later.progress, 1.0 / 3.0, 1e-12);
  const auto rows = studies_.listRows(kTenant, id);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].job.id, fresh.job_ids[0]);
  EXPECT_EQ(rows[0].quality_json, R"({"q":1})");
  EXPECT_EQ(rows[1].quality_json, "");
  api::ListFilter of_study;
  of_study.study_id = id;
  EXPECT_EQ(jobs_.list(kTenant, of_study, {}).items.size(), 3U);
}

TEST_F(StudyStoreTest, IsSubmittedWholeOrNotAtAll) {
  NewStudy study = makeStudy(3);
  study.jobs[2].trial_id = "tri_none";
  EXPECT_EQ(codeOf([&] { studies_.submit(study); }), ErrorCode::kTrialNotFound);
  EXPECT_EQ(queryInteger(database_, "SELECT count(*) FROM jobs"), 0);
  EXPECT_EQ(queryInteger(database_, "SELECT count(*) FROM studies"), 0);
  EXPECT_EQ(codeOf([&] {
              studies_.submit(makeStudy(3), {0, 2, 0, 0});
            }),
            ErrorCode::kQuotaExceeded);
  EXPECT_EQ(queryInteger(database_, "SELECT count(*) FROM jobs"), 0);
}

TEST_F(StudyStoreTest, SubmissionRepeatedUnderItsKeyIsOneStudy) {
  NewStudy study = makeStudy(2);
  study.submission_key = "k";
  EXPECT_EQ(studies_.submit(study), studies_.submit(study));
  EXPECT_EQ(queryInteger(database_, "SELECT count(*) FROM jobs"), 2);
}

TEST_F(StudyStoreTest, CancelsWhatHasNotEndedAndIsRemovedWhole) {
  const std::string id = studies_.submit(makeStudy(3));
  jobs_.succeed(claim(), {}, "pass");
  const JobTicket running = claim();
  EXPECT_EQ(codeOf([&] { studies_.remove(kTenant, id); }), ErrorCode::kJobState);
  EXPECT_EQ(studies_.requestCancel(kTenant, id), std::vector<std::string>{running.job_id});
  const api::StudyView view = studies_.find(kTenant, id);
  EXPECT_EQ(view.jobs.at("cancelled"), 1);
  EXPECT_EQ(view.jobs.at("succeeded"), 1);
  jobs_.cancelRunning(running);
  EXPECT_TRUE(studies_.requestCancel(kTenant, id).empty());
  const std::int64_t version = studies_.find(kTenant, id).version;
  jobs_.remove(kTenant, running.job_id);
  EXPECT_GT(studies_.find(kTenant, id).version, version) << "a smaller study is another one";
  studies_.remove(kTenant, id);
  EXPECT_EQ(queryInteger(database_, "SELECT count(*) FROM jobs"), 0);
  EXPECT_EQ(codeOf([&] { studies_.find(kTenant, id); }), ErrorCode::kStudyNotFound);
}

TEST_F(StudyStoreTest, AnotherTenantsStudyDoesNotExist) {
  const std::string id = studies_.submit(makeStudy(1));
  const auto expect_absent = [](auto call) {
    EXPECT_EQ(codeOf(call), ErrorCode::kStudyNotFound);
  };
  expect_absent([&] { studies_.find("lab_b", id); });
  expect_absent([&] { studies_.listRows("lab_b", id); });
  expect_absent([&] { studies_.requestCancel("lab_b", id); });
  expect_absent([&] { studies_.remove("lab_b", id); });
  EXPECT_TRUE(studies_.list("lab_b", {}, {}).items.empty());
  api::ListFilter label;
  label.label = "2026";
  EXPECT_EQ(studies_.list(kTenant, label, {}).items.size(), 1U);
  EXPECT_EQ(codeOf([&] { studies_.list(kTenant, {}, {"job_1", 5}); }), ErrorCode::kRequestField);
}

class CatalogStoreTest : public StorageTest {
 protected:
  NewCatalogEntry makeEntry(const std::string& document) {
    NewCatalogEntry entry;
    entry.tenant = kTenant;
    entry.name = "mine";
    entry.document = document;
    entry.summary_json = R"({"bodies":22})";
    return entry;
  }

  CatalogStore models_{database_, CatalogKind::kModel};
  CatalogStore sets_{database_, CatalogKind::kMarkerSet};
};

TEST_F(CatalogStoreTest, KeepsDocumentsOfBothKindsApart) {
  const api::CatalogEntry model = models_.add(makeEntry("<osim/>"));
  const api::CatalogEntry set = sets_.add(makeEntry("{}"));
  EXPECT_EQ(model.id.substr(0, 4), "mod_");
  EXPECT_EQ(set.id.substr(0, 4), "mks_");
  EXPECT_EQ(model.size, 7);
  EXPECT_EQ(model.summary_json, R"({"bodies":22})");
  EXPECT_FALSE(model.shipped);
  EXPECT_EQ(api::readAll(*models_.readDocument(kTenant, model.id).bytes, 100), "<osim/>");
  EXPECT_EQ(models_.list(kTenant, {}).items.size(), 1U);
  EXPECT_EQ(codeOf([&] { models_.find(kTenant, set.id); }), ErrorCode::kModelNotFound);
  EXPECT_EQ(codeOf([&] { sets_.find(kTenant, model.id); }), ErrorCode::kMarkerSetNotFound);
}

TEST_F(CatalogStoreTest, AnotherTenantsEntryDoesNotExist) {
  const std::string id = models_.add(makeEntry("<osim/>")).id;
  EXPECT_EQ(codeOf([&] { models_.find("lab_b", id); }), ErrorCode::kModelNotFound);
  EXPECT_EQ(codeOf([&] { models_.readDocument("lab_b", id); }), ErrorCode::kModelNotFound);
  EXPECT_EQ(codeOf([&] { models_.remove("lab_b", id); }), ErrorCode::kModelNotFound);
  EXPECT_TRUE(models_.list("lab_b", {}).items.empty());
}

TEST_F(CatalogStoreTest, EntriesInUseStay) {
  const std::string model = models_.add(makeEntry("<osim/>")).id;
  NewJob job = makeJob(trial_);
  job.model_id = model;
  const std::string job_id = jobs_.submit(job);
  EXPECT_EQ(codeOf([&] { models_.remove(kTenant, model); }), ErrorCode::kCatalogInUse);
  jobs_.requestCancel(kTenant, job_id);
  jobs_.remove(kTenant, job_id);
  models_.remove(kTenant, model);
  EXPECT_EQ(codeOf([&] { models_.find(kTenant, model); }), ErrorCode::kModelNotFound);
  const std::string set = sets_.add(makeEntry("{}")).id;
  NewTrial trial = makeTrial({});
  trial.subject.marker_set = set;
  trials_.add(trial);
  EXPECT_EQ(codeOf([&] { sets_.remove(kTenant, set); }), ErrorCode::kCatalogInUse);
}

TEST(KeyStore, FindsKeysInForceByTheirHash) {
  const TemporaryFolder folder;
  Database database({folder / "mill.db"});
  KeyStore keys(database);
  EXPECT_FALSE(keys.hasKeys());
  api::KeyView wanted;
  wanted.tenant = kTenant;
  wanted.name = "robot";
  wanted.scopes = {"read", "write"};
  const std::int64_t version = keys.version();
  const api::KeyView key = keys.add(wanted, "hash1");
  EXPECT_GT(keys.version(), version);
  EXPECT_EQ(keys.findBySecretHash("hash1").value().id, key.id);
  EXPECT_EQ(keys.findBySecretHash("hash1").value().scopes, wanted.scopes);
  EXPECT_FALSE(keys.findBySecretHash("hash2").has_value());
  EXPECT_TRUE(keys.hasKeys());
  EXPECT_EQ(keys.list(kTenant).size(), 1U);
  EXPECT_TRUE(keys.list("lab_b").empty());
  EXPECT_EQ(codeOf([&] { keys.revoke("lab_b", key.id); }), ErrorCode::kKeyNotFound);
  keys.revoke(kTenant, key.id);
  EXPECT_FALSE(keys.findBySecretHash("hash1").has_value());
  EXPECT_FALSE(keys.hasKeys());
  EXPECT_GT(keys.list("").at(0).revoked_at, 0);
  EXPECT_NO_THROW(keys.revoke("", key.id)) << "twice is once";
}

class IdempotencyStoreTest : public StorageTest {
 protected:
  IdempotencyStore store_{database_, "serve:1"};
};

TEST_F(IdempotencyStoreTest, KeepsTheFirstAnswer) {
  EXPECT_FALSE(store_.begin(kTenant, "k", "hash").has_value());
  EXPECT_EQ(store_.begin(kTenant, "k", "hash").value().status, 0) << "still being answered";
  store_.finish(kTenant, "k", {"hash", 202, "application/json", "/v1/jobs/1", "{}"});
  const api::KeptAnswer kept = store_.begin(kTenant, "k", "other").value();
  EXPECT_EQ(kept.status, 202);
  EXPECT_EQ(kept.request_hash, "hash");
  EXPECT_EQ(kept.location, "/v1/jobs/1");
  EXPECT_EQ(kept.body, "{}");
  EXPECT_FALSE(store_.begin("lab_b", "k", "hash").has_value()) << "keys belong to a tenant";
}

TEST_F(IdempotencyStoreTest, AbandonedAndExpiredKeysAreFree) {
  store_.begin(kTenant, "k", "hash");
  store_.abandon(kTenant, "k");
  EXPECT_FALSE(store_.begin(kTenant, "k", "hash").has_value());
  store_.finish(kTenant, "k", {"hash", 202, "", "", ""});
  store_.abandon(kTenant, "k");
  EXPECT_TRUE(store_.begin(kTenant, "k", "hash").has_value()) << "answers are not abandoned";
  EXPECT_EQ(store_.removeExpired(), 0);
  tamper(database_, "UPDATE idempotency SET created_at = created_at - 90000000");
  EXPECT_FALSE(store_.begin(kTenant, "k", "hash").has_value());
  tamper(database_, "UPDATE idempotency SET created_at = created_at - 90000000");
  EXPECT_EQ(store_.removeExpired(), 1);
}

TEST_F(IdempotencyStoreTest, RequestThatDiedWithItsProcessMayBeginAgain) {
  store_.begin(kTenant, "k", "hash");
  IdempotencyStore next(database_, "serve:2");
  EXPECT_FALSE(next.begin(kTenant, "k", "hash").has_value());
  EXPECT_TRUE(next.begin(kTenant, "k", "hash").has_value());
}

TEST_F(IdempotencyStoreTest, OtherRequestUnderADeadRequestsKeyIsNotItsRepetition) {
  store_.begin(kTenant, "k", "hash");
  IdempotencyStore next(database_, "serve:2");
  const auto known = next.begin(kTenant, "k", "other");
  ASSERT_TRUE(known.has_value());
  EXPECT_EQ(known->request_hash, "hash");
}

TEST_F(IdempotencyStoreTest, KeyOfYesterdayStoresAnew) {
  TrialStore trials(database_);
  NewTrial trial;
  trial.tenant = kTenant;
  trial.subject.mass = 70;
  trial.subject.height = 1.7;
  trial.submission_key = "k";
  store_.begin(kTenant, "k", "hash");
  const std::string first = trials.add(trial).id;
  EXPECT_EQ(trials.add(trial).id, first);
  tamper(database_, "UPDATE idempotency SET created_at = created_at - 90000000");
  EXPECT_FALSE(store_.begin(kTenant, "k", "hash").has_value());
  const std::string second = trials.add(trial).id;
  EXPECT_NE(second, first);
  store_.removeExpired();
  EXPECT_EQ(trials.add(trial).id, second) << "stored today";
  tamper(database_, "UPDATE trials SET created_at = created_at - 90000000");
  store_.removeExpired();
  EXPECT_NE(trials.add(trial).id, second);
}

}  // namespace
}  // namespace gaitmill

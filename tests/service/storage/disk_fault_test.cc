// Failing disks: the n-th write, sync, truncation or opening fails, for every n of a job's whole
// life. Whatever was acknowledged is there afterwards, nothing is half there, and the file is
// sound.

#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "service/storage/database.h"
#include "service/storage/job_store.h"
#include "service/storage/migrations.h"
#include "service/storage/sqlite.h"
#include "service/storage/trial_store.h"
#include "tests/service/storage/faulty_vfs.h"
#include "tests/service/storage/storage_fixture.h"
#include "tests/support/temporary_folder.h"

namespace gaitmill {
namespace {

struct Fault {
  DiskFault fault;
  FaultLasts lasts;
};

// What the caller was told.
struct Acknowledged {
  std::string trial;
  std::string job;
  bool claimed = false;
  int stages = 0;
  bool succeeded = false;
  bool removed = false;
};

const std::string& bytesOfTrial() {
  static const std::string bytes = makeNoise(40'000, 11);
  return bytes;
}

DatabaseOptions optionsFor(const std::string& path) {
  return {path, DatabaseUse::kServe, 0, 0, FaultyVfs::name()};
}

FinishedStage makeStage(const std::string& name) {
  FinishedStage stage;
  stage.stage = name;
  stage.checkpoint = makeNoise(20'000, static_cast<unsigned>(name.size()));
  stage.results = {{ResultKind::kTime, name, makeNoise(9'000, 2), ""}};
  stage.stages = {{name, 1.0, 1.0}};
  return stage;
}

class DiskFaultTest : public ::testing::TestWithParam<Fault> {
 protected:
  ~DiskFaultTest() override { FaultyVfs::heal(); }

  // True if it succeeds; a failure must be a clean error of the storage.
  template <class Step>
  bool attempt(Step step) {
    try {
      step();
      return true;
    } catch (const Error& error) {
      EXPECT_TRUE(error.code() == ErrorCode::kStorage || error.code() == ErrorCode::kStorageFull)
          << error.what();
      return false;
    }
  }

  Acknowledged live(Database& database);
  void expectAllThere(const std::string& path, const Acknowledged& told);
};

// A job's life. Every step is tried again once, as a caller would, until one has failed twice.
Acknowledged DiskFaultTest::live(Database& database) {
  TrialStore trials(database);
  JobStore jobs(database);
  Acknowledged told;
  const auto tryTwice = [this](auto step) {
    return attempt(step) || attempt(step);
  };
  if (!tryTwice([&] {
        told.trial = trials.add(makeTrial({{"markers", bytesOfTrial()}})).id;
      }) ||
      !tryTwice([&] { told.job = jobs.submit(makeJob(told.trial)); })) {
    return told;
  }
  JobTicket ticket;
  if (!tryTwice([&] { ticket = jobs.claimNext("serve:1", kLease).value().ticket; })) {
    return told;
  }
  told.claimed = true;
  for (const char* stage : {"ik", "rra"}) {
    if (!tryTwice([&] { EXPECT_TRUE(jobs.saveStage(ticket, makeStage(stage))); })) {
      return told;
    }
    ++told.stages;
  }
  told.succeeded = tryTwice([&] {
    jobs.succeed(ticket, {{ResultKind::kSummary, "quality", "{}", ""}}, "pass");
  });
  if (told.succeeded) {
    attempt([&] {
      jobs.remove(kTenant, told.job);
      told.removed = true;
    });
  }
  return told;
}

void DiskFaultTest::expectAllThere(const std::string& path, const Acknowledged& told) {
  Database database(optionsFor(path));
  EXPECT_EQ(database.checkIntegrity(), "ok");
  EXPECT_EQ(queryInteger(database, "SELECT count(*) FROM pragma_foreign_key_check"), 0);
  TrialStore trials(database);
  JobStore jobs(database);
  if (!told.trial.empty()) {
    const api::FileContent content = trials.readFile(kTenant, told.trial, "markers");
    EXPECT_TRUE(api::readAll(*content.bytes, 1U << 20U) == bytesOfTrial());
  }
  if (told.removed) {
    EXPECT_EQ(codeOf([&] { jobs.find(kTenant, told.job); }), ErrorCode::kJobNotFound);
    EXPECT_EQ(queryInteger(database, "SELECT count(*) FROM results"), 0);
    return;
  }
  // A removal that failed may still have happened: its answer got lost, no more.
  if (told.job.empty() ||
      (told.succeeded && queryInteger(database, "SELECT count(*) FROM jobs") == 0)) {
    return;
  }
  const api::JobView job = jobs.find(kTenant, told.job);
  EXPECT_FALSE(told.claimed && job.state == api::JobState::kQueued);
  EXPECT_FALSE(told.succeeded && job.state != api::JobState::kSucceeded);
  const auto tables = static_cast<int>(jobs.listResults(kTenant, told.job).size()) -
                      (job.state == api::JobState::kSucceeded ? 1 : 0);
  EXPECT_GE(tables, told.stages);
  if (job.state == api::JobState::kRunning) {
    EXPECT_EQ(static_cast<int>(jobs.readCheckpoints(told.job).size()), tables)
        << "a stage comes with its results or not at all";
    EXPECT_EQ(static_cast<int>(job.stages.size()), tables > 0 ? 1 : 0);
  }
  for (const ResultInfo& result : jobs.listResults(kTenant, told.job)) {
    EXPECT_NO_THROW(jobs.readResult(kTenant, told.job, result.kind, result.name));
  }
}

TEST_P(DiskFaultTest, AtAnyWriteOfAJobsLifeLosesNothingAcknowledged) {
  const Fault fault = GetParam();
  bool was_hit = true;
  int n = 1;
  for (; was_hit && !HasFailure(); ++n) {
    SCOPED_TRACE("operation " + std::to_string(n));
    const TemporaryFolder folder;
    const std::string path = folder / "mill.db";
    Acknowledged told;
    {
      Database database(optionsFor(path));
      FaultyVfs::failAt(n, fault.fault, fault.lasts);
      told = live(database);
      was_hit = FaultyVfs::countOperations() >= n;
      FaultyVfs::heal();
      if (was_hit) {
        TrialStore trials(database);
        EXPECT_NO_THROW(trials.add(makeTrial({}))) << "recovers when the disk does";
        EXPECT_EQ(database.findShortage(), "");
      }
    }
    expectAllThere(path, told);
  }
  EXPECT_GT(n, 60) << "the scenario writes more than that";
  RecordProperty("operations", n);
}

// A database of version 3, opened by this binary on a failing disk: it is of some version between,
// sound, and the next start completes it.
TEST_P(DiskFaultTest, AtAnyWriteOfTheMigrationsLeavesADatabaseToGoOnFrom) {
  const Fault fault = GetParam();
  bool was_hit = true;
  int n = 1;
  for (; was_hit && !HasFailure(); ++n) {
    SCOPED_TRACE("operation " + std::to_string(n));
    const TemporaryFolder folder;
    const std::string path = folder / "mill.db";
    {
      const auto db = openSqlite({path, FaultyVfs::name(), 0});
      db->runScript(
          "CREATE TABLE schema_versions (version INTEGER PRIMARY KEY, name TEXT NOT NULL)");
      for (int i = 0; i < 3; ++i) {
        db->runScript(allMigrations()[static_cast<std::size_t>(i)].sql);
        db->runScript(
            ("INSERT INTO schema_versions VALUES (" + std::to_string(i + 1) + ", 'x')").c_str());
      }
      db->runScript(
          "INSERT INTO trials VALUES ('tri_1', 0, 70, 1.7, NULL, '{}', '[]', '[]');"
          "INSERT INTO jobs VALUES ('job_1', 'tri_1', '', '{}', 'queued', 0, 0, 0, 5, NULL, NULL, "
          "NULL)");
    }
    FaultyVfs::failAt(n, fault.fault, fault.lasts);
    attempt([&] { const Database database(optionsFor(path)); });
    was_hit = FaultyVfs::countOperations() >= n;
    FaultyVfs::heal();
    Database database(optionsFor(path));
    EXPECT_EQ(database.checkIntegrity(), "ok");
    EXPECT_EQ(queryInteger(database, "SELECT max(version) FROM schema_versions"),
              static_cast<std::int64_t>(allMigrations().size()));
    EXPECT_EQ(JobStore(database).find("local", "job_1").settings_json, "{}");
  }
  EXPECT_GT(n, 60);
}

INSTANTIATE_TEST_SUITE_P(Faults,
                         DiskFaultTest,
                         ::testing::Values(Fault{DiskFault::kInputOutput, FaultLasts::kOnce},
                                           Fault{DiskFault::kInputOutput, FaultLasts::kUntilHealed},
                                           Fault{DiskFault::kFull, FaultLasts::kOnce},
                                           Fault{DiskFault::kFull, FaultLasts::kUntilHealed}));

TEST(DiskFull, IsToldFromOtherFaultsAndReadsGoOn) {
  const TemporaryFolder folder;
  Database database(optionsFor(folder / "mill.db"));
  TrialStore trials(database);
  const std::string trial = trials.add(makeTrial({{"markers", "bytes"}})).id;
  FaultyVfs::failAt(1, DiskFault::kFull, FaultLasts::kUntilHealed);
  EXPECT_EQ(codeOf([&] { trials.add(makeTrial({})); }), ErrorCode::kStorageFull);
  EXPECT_EQ(trials.find(kTenant, trial).files.size(), 1U);
  EXPECT_NE(database.findShortage(), "");
  FaultyVfs::failAt(1, DiskFault::kInputOutput, FaultLasts::kUntilHealed);
  EXPECT_EQ(codeOf([&] { trials.add(makeTrial({})); }), ErrorCode::kStorage);
  FaultyVfs::heal();
  EXPECT_NO_THROW(trials.add(makeTrial({})));
  EXPECT_EQ(database.findShortage(), "");
}

}  // namespace
}  // namespace gaitmill

// Databases as each earlier binary left them, opened by this one: everything in them can be read.

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "service/storage/key_store.h"
#include "service/storage/migrations.h"
#include "service/storage/sha256.h"
#include "service/storage/sqlite.h"
#include "tests/service/storage/storage_fixture.h"

namespace gaitmill {
namespace {

constexpr const char* kLocal = "local";
constexpr const char* kUnderstood =
    R"([{"part":"markers","name":"walk.trc","size_bytes":6,"sha256":"x","format":"trc",)"
    R"("frames":3,"rate_hz":100.0,"start_s":0.0,"end_s":0.02,"units":"mm","markers":["RASI"]}])";

const std::string& trialBytes() {
  static const std::string bytes("by\0tes", 6);
  return bytes;
}

void insertTrial(Connection& db, const std::string& id, std::int64_t created_at) {
  db.prepare("INSERT INTO trials VALUES (?1, ?2, 75.3, 1.7, 'lab_a', '{\"ik\":{}}', ?3, '[\"w\"]')")
      .bind(1, id)
      .bind(2, created_at)
      .bind(3, kUnderstood)
      .run();
}

// As 0001 was used: bytes whole, in the blob's row.
void populateTrials(Connection& db) {
  const std::string hash = calcSha256(trialBytes());
  db.prepare("INSERT INTO blobs VALUES (?1, 6, ?2)").bind(1, hash).bindBytes(2, trialBytes()).run();
  db.prepare("INSERT INTO blobs VALUES (?1, 0, x'')").bind(1, calcSha256("")).run();
  for (const char* id : {"tri_01hf3v6k9e2m8xw7p0q4t5r6s1", "tri_01hf3v6k9e2m8xw7p0q4t5r6s2"}) {
    insertTrial(db, id, 1'700'000'000'000);
    db.prepare("INSERT INTO trial_files VALUES (?1, 'markers', 'walk.trc', ?2)")
        .bind(1, id)
        .bind(2, hash)
        .run();
  }
  db.prepare(
        "INSERT INTO trial_files VALUES ('tri_01hf3v6k9e2m8xw7p0q4t5r6s1', 'emg', 'e.sto', ?1)")
      .bind(1, calcSha256(""))
      .run();
}

// As 0002 was used: one job in each state, the queued one given back once.
void populateJobs(Connection& db) {
  db.runScript(R"sql(
    INSERT INTO jobs VALUES ('job_01hf3v6k9e2m8xw7p0q4t5r6q1', 'tri_01hf3v6k9e2m8xw7p0q4t5r6s1',
      'default', '{"a":1}', 'queued', 1, 1, 0, 100, 110, NULL, NULL);
    INSERT INTO jobs VALUES ('job_01hf3v6k9e2m8xw7p0q4t5r6q2', 'tri_01hf3v6k9e2m8xw7p0q4t5r6s1',
      '', '{"b":2}', 'running', 1, 0, 0, 101, 111, NULL, NULL);
    INSERT INTO jobs VALUES ('job_01hf3v6k9e2m8xw7p0q4t5r6q3', 'tri_01hf3v6k9e2m8xw7p0q4t5r6s1',
      'default', '{}', 'succeeded', 1, 0, 0, 102, 112, 122, NULL);
    INSERT INTO jobs VALUES ('job_01hf3v6k9e2m8xw7p0q4t5r6q4', 'tri_01hf3v6k9e2m8xw7p0q4t5r6s1',
      'default', '{}', 'failed', 1, 0, 0, 103, 113, 123,
      '{"code":"input.markers","message":"no marker","where":{"file":"w.trc","line":3}}');
    INSERT INTO jobs VALUES ('job_01hf3v6k9e2m8xw7p0q4t5r6q5', 'tri_01hf3v6k9e2m8xw7p0q4t5r6s1',
      'default', '{}', 'cancelled', 0, 0, 1, 104, NULL, 124, NULL);
    INSERT INTO job_stages VALUES ('job_01hf3v6k9e2m8xw7p0q4t5r6q3', 0, 'ik', 1.5, 1.0);
    INSERT INTO job_stages VALUES ('job_01hf3v6k9e2m8xw7p0q4t5r6q2', 0, 'ik', 0.5, 0.3);
    INSERT INTO job_warnings VALUES ('job_01hf3v6k9e2m8xw7p0q4t5r6q3', 0, 'careful');
  )sql");
}

// As 0003 was used: bytes as they are.
void populateResults(Connection& db) {
  db.prepare(
        "INSERT INTO results VALUES ('job_01hf3v6k9e2m8xw7p0q4t5r6q3', 'file', 'ik.mot', 6, ?1, "
        "?2)")
      .bind(1, calcSha256(trialBytes()))
      .bindBytes(2, trialBytes())
      .run();
}

void writeVersion(const std::string& path, std::size_t version) {
  const auto db = openSqlite({path, "", 0});
  db->runScript("CREATE TABLE schema_versions (version INTEGER PRIMARY KEY, name TEXT NOT NULL)");
  for (std::size_t i = 0; i < version; ++i) {
    db->runScript(allMigrations()[i].sql);
    db->prepare("INSERT INTO schema_versions VALUES (?1, ?2)")
        .bind(1, static_cast<std::int64_t>(i + 1))
        .bind(2, allMigrations()[i].name)
        .run();
  }
  using Populate = void (*)(Connection&);
  const std::vector<Populate> steps = {populateTrials, populateJobs, populateResults};
  for (std::size_t i = 0; i < std::min(version, steps.size()); ++i) {
    steps[i](*db);
  }
}

void expectTrials(Database& database) {
  TrialStore trials(database);
  const auto page = trials.list(kLocal, {}, {});
  ASSERT_EQ(page.items.size(), 2U);
  const api::TrialView trial = trials.find(kLocal, "tri_01hf3v6k9e2m8xw7p0q4t5r6s1");
  EXPECT_EQ(trial.subject.mass, 75.3);
  EXPECT_EQ(trial.subject.marker_set, "lab_a");
  EXPECT_EQ(trial.subject.options, R"({"ik":{}})");
  EXPECT_EQ(trial.created_at, 1'700'000'000'000);
  EXPECT_EQ(trial.warnings, std::vector<std::string>{"w"});
  ASSERT_EQ(trial.files.size(), 1U);
  EXPECT_EQ(trial.files[0].labels, std::vector<std::string>{"RASI"});
  EXPECT_TRUE(nlohmann::json::accept(api::renderTrial(trial)));
  const auto read = [&](const std::string& part) {
    return api::readAll(*trials.readFile(kLocal, trial.id, part).bytes, 100);
  };
  EXPECT_EQ(read("markers"), trialBytes());
  EXPECT_EQ(read("emg"), "");
  EXPECT_EQ(KeyStore(database).findUsage(kLocal, "").trials, 2);
  EXPECT_EQ(KeyStore(database).findUsage(kLocal, "").bytes, 12);
  // The new rules hold for the old bytes: stored once, deleted with their last use.
  trials.add(makeTrial({{"markers", trialBytes()}}));
  trials.remove(kLocal, "tri_01hf3v6k9e2m8xw7p0q4t5r6s2");
  EXPECT_EQ(queryInteger(database, "SELECT uses FROM blobs WHERE size = 6"), 2);
}

void expectJobs(Database& database) {
  using State = api::JobState;
  JobStore jobs(database);
  const auto find = [&jobs](const char* digit) {
    return jobs.find(kLocal, std::string("job_01hf3v6k9e2m8xw7p0q4t5r6q") + digit);
  };
  EXPECT_EQ(find("1").state, State::kQueued);
  EXPECT_EQ(find("1").settings_json, R"({"a":1})");
  EXPECT_EQ(find("2").state, State::kRunning);
  EXPECT_EQ(find("3").state, State::kSucceeded);
  EXPECT_EQ(find("3").stages.at(0).seconds, 1.5);
  EXPECT_EQ(find("3").warnings, std::vector<std::string>{"careful"});
  const auto problem = nlohmann::json::parse(find("4").error.value());
  EXPECT_EQ(problem["code"], "input.markers");
  EXPECT_EQ(problem["detail"], "no marker");
  EXPECT_EQ(problem["where"]["line"], 3);
  EXPECT_TRUE(problem.contains("fix") && problem.contains("title")) << "a problem like any other";
  EXPECT_EQ(find("5").state, State::kCancelled);
  EXPECT_EQ(jobs.list(kLocal, {}, {}).items.size(), 5U);
  EXPECT_EQ(KeyStore(database).findUsage(kLocal, "").jobs, 5);
  const auto events = jobs.listEvents(kLocal, find("3").id, 0);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].data, R"({"state":"succeeded"})");
  EXPECT_EQ(events[0].id, find("3").version);
  // Jobs that waited or ran go on, oldest first.
  const ClaimedJob first = jobs.claimNext("serve:1", kLease).value();
  EXPECT_EQ(first.ticket.job_id, find("1").id);
  EXPECT_EQ(first.ticket.claim, 2);
  EXPECT_EQ(first.tenant, kLocal);
  EXPECT_EQ(first.deaths, 1);
  const ClaimedJob second = jobs.claimNext("serve:1", kLease).value();
  EXPECT_EQ(second.ticket.job_id, find("2").id);
  EXPECT_TRUE(second.stages.empty()) << "it has no checkpoints and begins anew";
  EXPECT_FALSE(jobs.claimNext("serve:1", kLease).has_value());
  EXPECT_TRUE(jobs.succeed(first.ticket, {{ResultKind::kFile, "f", "x", ""}}, "pass"));
}

void expectResults(Database& database) {
  JobStore jobs(database);
  const api::FileContent file = jobs.readFile(kLocal, "job_01hf3v6k9e2m8xw7p0q4t5r6q3", "ik.mot");
  EXPECT_EQ(api::readAll(*file.bytes, 100), trialBytes());
}

class MigrationTest : public ::testing::TestWithParam<std::size_t> {};

TEST_P(MigrationTest, BringsTheDatabaseOfAnEarlierVersionHere) {
  const std::size_t version = GetParam();
  const TemporaryFolder folder;
  writeVersion(folder / "mill.db", version);
  Database database({folder / "mill.db"});
  EXPECT_EQ(queryInteger(database, "SELECT max(version) FROM schema_versions"),
            static_cast<std::int64_t>(allMigrations().size()));
  EXPECT_EQ(database.checkIntegrity(), "ok");
  EXPECT_EQ(queryInteger(database, "SELECT count(*) FROM pragma_foreign_key_check"), 0);
  if (version >= 1) {
    expectTrials(database);
  }
  if (version >= 2) {
    expectJobs(database);
  }
  if (version >= 3) {
    expectResults(database);
  }
}

INSTANTIATE_TEST_SUITE_P(FromVersion, MigrationTest, ::testing::Values(0U, 1U, 2U, 3U));

// Whatever way a database came here, it has the same shape.
TEST(Migrations, LeadToOneShape) {
  std::string fresh_shape;
  for (std::size_t version = 0; version <= 3; ++version) {
    const TemporaryFolder folder;
    writeVersion(folder / "mill.db", version);
    Database database({folder / "mill.db"});
    const std::string shape = queryText(
        database,
        "SELECT group_concat(sql, ';') FROM (SELECT sql FROM sqlite_schema ORDER BY name)");
    if (version == 0) {
      fresh_shape = shape;
    }
    EXPECT_EQ(shape, fresh_shape);
  }
}

TEST(Migrations, HaveNumbersInTheirOrder) {
  std::size_t number = 0;
  for (const Migration& migration : allMigrations()) {
    EXPECT_EQ(std::stoul(std::string(migration.name).substr(0, 4)), ++number);
  }
}

}  // namespace
}  // namespace gaitmill

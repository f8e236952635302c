#include "service/storage/database.h"

#include <sys/stat.h>

#include <future>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "service/storage/migrations.h"
#include "tests/service/storage/storage_fixture.h"
#include "tests/support/temporary_folder.h"

namespace gaitmill {
namespace {

ErrorCode openError(const DatabaseOptions& options) {
  return codeOf([&options] { const Database database(options); });
}

TEST(Database, IsDurableAndChecksReferences) {
  const TemporaryFolder folder;
  Database database({folder / "mill.db"});
  EXPECT_EQ(queryText(database, "PRAGMA journal_mode"), "wal");
  EXPECT_EQ(queryInteger(database, "PRAGMA synchronous"), 2) << "2 = fsync at every commit";
  EXPECT_EQ(queryInteger(database, "PRAGMA foreign_keys"), 1);
  EXPECT_EQ(queryInteger(database, "PRAGMA secure_delete"), 1);
  EXPECT_THROW(tamper(database, "INSERT INTO trial_files VALUES ('tri_none', 'markers', 'a', 1)"),
               Error);
  EXPECT_EQ(database.checkIntegrity(), "ok");
}

TEST(Database, IsForItsOwnerAlone) {
  const TemporaryFolder folder;
  Database database({folder / "mill.db"});
  tamper(database, "UPDATE counters SET value = value");
  for (const char* suffix : {"", "-wal", "-shm"}) {
    struct stat status {};
    ASSERT_EQ(::stat((folder / (std::string("mill.db") + suffix)).c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0600U) << suffix;
  }
}

TEST(Database, HasSeenAllMigrationsOnce) {
  const TemporaryFolder folder;
  for (int opening = 0; opening < 2; ++opening) {
    Database database({folder / "mill.db"});
    EXPECT_EQ(queryInteger(database, "SELECT count(*) FROM schema_versions"),
              static_cast<std::int64_t>(allMigrations().size()));
  }
}

TEST(Database, NewerThanTheBinaryIsRefused) {
  const TemporaryFolder folder;
  {
    Database database({folder / "mill.db"});
    tamper(database, "INSERT INTO schema_versions VALUES (999, 'from the future')");
  }
  EXPECT_EQ(openError({folder / "mill.db"}), ErrorCode::kStorageVersion);
}

TEST(Database, HasOneServiceAndAnyNumberOfWorkers) {
  const TemporaryFolder folder;
  const Database worker({folder / "mill.db", DatabaseUse::kWork});
  const Database service({folder / "mill.db"});
  const Database other({folder / "mill.db", DatabaseUse::kWork});
  EXPECT_EQ(openError({folder / "mill.db"}), ErrorCode::kStorageInUse);
}

TEST(Database, ThatIsNoneIsRefused) {
  const TemporaryFolder folder;
  folder.write("mill.db", std::string(5000, 'x'));
  EXPECT_EQ(openError({folder / "mill.db"}), ErrorCode::kStorage);
  EXPECT_EQ(openError({folder / "absent/mill.db"}), ErrorCode::kStorage);
}

TEST(Database, ReadsAreOfOneInstant) {
  const TemporaryFolder folder;
  Database database({folder / "mill.db"});
  const ReadTransaction before = database.read();
  const auto count = [](const ReadTransaction& db) {
    Statement row = db->prepare("SELECT value FROM counters WHERE name = 'jobs'");
    row.step();
    return row.integer(0);
  };
  EXPECT_EQ(count(before), 0);
  tamper(database, "UPDATE counters SET value = 7");
  EXPECT_EQ(count(before), 0);
  EXPECT_EQ(count(database.read()), 7);
}

TEST(Database, UploadsLeaveTheFloorFree) {
  const TemporaryFolder folder;
  DatabaseOptions options{folder / "mill.db"};
  options.free_floor = std::int64_t{1} << 60;
  Database database(options);
  EXPECT_EQ(codeOf([&] { database.requireRoom(1); }), ErrorCode::kStorageFull);
  EXPECT_NE(database.findShortage(), "");
  TrialStore trials(database);
  EXPECT_EQ(codeOf([&] {
              trials.add(makeTrial({{"markers", "bytes"}}));
            }),
            ErrorCode::kStorageFull);
  EXPECT_NO_THROW(trials.add(makeTrial({}))) << "small rows still go in";
}

TEST(Write, UndoesWhatThrowsAndNothingElse) {
  const TemporaryFolder folder;
  Database database({folder / "mill.db"});
  const auto set = [](Connection& db, std::int64_t value) {
    db.prepare("UPDATE counters SET value = ?1 WHERE name = 'keys'").bind(1, value).run();
  };
  EXPECT_EQ(codeOf([&] {
              database.write([&](Connection& db) {
                set(db, 5);
                throw Error(ErrorCode::kQuotaExceeded, "no");
              });
            }),
            ErrorCode::kQuotaExceeded);
  EXPECT_EQ(queryInteger(database, "SELECT value FROM counters WHERE name = 'keys'"), 0);
  database.write([&](Connection& db) { set(db, 6); });
  EXPECT_EQ(queryInteger(database, "SELECT value FROM counters WHERE name = 'keys'"), 6);
  EXPECT_EQ(database.findShortage(), "");
}

// The first closure holds the writer until all others wait: they make up one batch.
TEST(Write, FailureInABatchDoesNotHurtItsNeighbours) {
  constexpr int kWriters = 12;
  const TemporaryFolder folder;
  Database database({folder / "mill.db"});
  std::promise<void> release;
  std::shared_future<void> released = release.get_future().share();
  std::thread first([&] { database.write([released](Connection&) { released.wait(); }); });
  std::vector<std::thread> writers;
  std::vector<ErrorCode> codes(kWriters, ErrorCode::kInternal);
  for (int i = 0; i < kWriters; ++i) {
    writers.emplace_back([&, i] {
      codes[static_cast<std::size_t>(i)] = codeOf([&] {
        database.write([i](Connection& db) {
          db.runScript("UPDATE counters SET value = value + 1 WHERE name = 'jobs'");
          require(i % 3 != 0, ErrorCode::kJobState, "every third one fails");
        });
      });
    });
  }
  release.set_value();
  first.join();
  for (std::thread& writer : writers) {
    writer.join();
  }
  EXPECT_EQ(queryInteger(database, "SELECT value FROM counters WHERE name = 'jobs'"), 8);
  for (int i = 0; i < kWriters; ++i) {
    EXPECT_EQ(codes[static_cast<std::size_t>(i)],
              i % 3 == 0 ? ErrorCode::kJobState : ErrorCode::kInternal);
  }
}

TEST(Write, BulkAndSmallOnesFromManyThreadsAllArrive) {
  constexpr int kThreads = 6;
  constexpr int kWrites = 20;
  const TemporaryFolder folder;
  Database database({folder / "mill.db"});
  const auto add = [](Connection& db) {
    db.runScript("UPDATE counters SET value = value + 1 WHERE name = 'jobs'");
  };
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&] {
      for (int i = 0; i < kWrites; ++i) {
        database.write(add);
        database.writeBulk(add);
        database.read();
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  EXPECT_EQ(queryInteger(database, "SELECT value FROM counters WHERE name = 'jobs'"),
            2 * kThreads * kWrites);
}

TEST(Write, PageLimitIsAFullDiskAndReadsGoOn) {
  const TemporaryFolder folder;
  DatabaseOptions options{folder / "mill.db"};
  options.max_size = 600 * 1024;
  Database database(options);
  TrialStore trials(database);
  const std::string small = trials.add(makeTrial({{"markers", "small"}})).id;
  EXPECT_EQ(codeOf([&] {
              trials.add(makeTrial({{"markers", makeNoise(1'000'000, 1)}}));
            }),
            ErrorCode::kStorageFull);
  EXPECT_NE(database.findShortage(), "");
  EXPECT_EQ(trials.find(kTenant, small).files.size(), 1U);
  EXPECT_EQ(database.checkIntegrity(), "ok");
  EXPECT_NO_THROW(trials.remove(kTenant, small));
  EXPECT_NO_THROW(trials.add(makeTrial({{"markers", "again"}})));
  EXPECT_EQ(database.findShortage(), "") << "recovered";
}

}  // namespace
}  // namespace gaitmill

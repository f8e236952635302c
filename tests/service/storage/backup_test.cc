#include "service/storage/backup.h"

#include <atomic>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/service/storage/storage_fixture.h"

namespace gaitmill {
namespace {

class BackupTest : public ::testing::Test {
 protected:
  std::string path() const { return folder_ / "mill.db"; }
  std::string backup() const { return folder_ / "backup.db"; }
  std::string restored() const { return folder_ / "restored.db"; }

  TemporaryFolder folder_;
};

// Four threads submit throughout. What was acknowledged before the backup began is in it, and what
// was acknowledged at all is in the database.
TEST_F(BackupTest, OfALiveDatabaseHasEverythingAcknowledgedBefore) {
  constexpr std::size_t kThreads = 4;
  constexpr std::size_t kBefore = 20;  // acknowledged to each thread when the backup begins
  Database database({path()});
  TrialStore trials(database);
  JobStore jobs(database);
  const std::string trial = trials.add(makeTrial({{"markers", makeNoise(3'000'000, 1)}})).id;
  std::atomic<bool> stopping{false};
  std::atomic<std::size_t> ready{0};
  std::vector<std::vector<std::string>> acknowledged(kThreads);
  std::vector<std::thread> writers;
  for (std::vector<std::string>& mine : acknowledged) {
    writers.emplace_back([&] {
      while (!stopping) {
        mine.push_back(jobs.submit(makeJob(trial)));
        if (mine.size() == kBefore) {
          ++ready;
        }
      }
    });
  }
  while (ready < kThreads) {
    std::this_thread::yield();
  }
  std::int64_t pages = 0;
  backUpDatabase(path(), backup(), [&pages](std::int64_t done, std::int64_t all) {
    EXPECT_LE(done, all);
    pages = done;
  });
  stopping = true;
  for (std::thread& writer : writers) {
    writer.join();
  }
  EXPECT_GT(pages, 700) << "3 MB in pages of 4 KiB";
  restoreDatabase(backup(), restored(), Existing::kKeep);
  Database again({restored()});
  JobStore restored_jobs(again);
  EXPECT_EQ(again.checkIntegrity(), "ok");
  for (const std::vector<std::string>& mine : acknowledged) {
    for (std::size_t i = 0; i < mine.size(); ++i) {
      EXPECT_NO_THROW(jobs.find(kTenant, mine[i]));
      if (i < kBefore) {
        EXPECT_NO_THROW(restored_jobs.find(kTenant, mine[i]));
      }
    }
  }
  const api::FileContent file = TrialStore(again).readFile(kTenant, trial, "markers");
  EXPECT_TRUE(api::readAll(*file.bytes, 1U << 30U) == makeNoise(3'000'000, 1));
  EXPECT_FALSE(std::filesystem::exists(backup() + ".partial"));
  EXPECT_FALSE(std::filesystem::exists(backup() + "-wal"));
}

TEST_F(BackupTest, AppearsWholeOrNotAtAll) {
  EXPECT_EQ(codeOf([&] { backUpDatabase(path(), backup()); }), ErrorCode::kStorage);
  { const Database database({path()}); }
  EXPECT_EQ(codeOf([&] { backUpDatabase(path(), folder_ / "absent/backup.db"); }),
            ErrorCode::kStorage);
  EXPECT_EQ(codeOf([&] { backUpDatabase(path(), path()); }), ErrorCode::kStorage);
  folder_.write("backup.db", "an old one");
  folder_.write("broken.db", std::string(5000, 'x'));
  EXPECT_EQ(codeOf([&] { backUpDatabase(folder_ / "broken.db", backup()); }), ErrorCode::kStorage);
  EXPECT_EQ(std::filesystem::file_size(backup()), 10U);
  EXPECT_FALSE(std::filesystem::exists(backup() + ".partial"));
  backUpDatabase(path(), backup());
  EXPECT_GT(std::filesystem::file_size(backup()), 4096U);
}

TEST_F(BackupTest, IsNotRestoredOverADatabaseInUse) {
  {
    const Database database({path()});
    backUpDatabase(path(), backup());
    EXPECT_EQ(codeOf([&] { restoreDatabase(backup(), path(), Existing::kReplace); }),
              ErrorCode::kStorageInUse);
  }
  {
    const Database worker({path(), DatabaseUse::kWork});
    EXPECT_EQ(codeOf([&] { restoreDatabase(backup(), path(), Existing::kReplace); }),
              ErrorCode::kStorageInUse);
  }
  EXPECT_EQ(codeOf([&] { restoreDatabase(backup(), path(), Existing::kKeep); }),
            ErrorCode::kStorageInUse);
  EXPECT_NO_THROW(restoreDatabase(backup(), path(), Existing::kReplace));
}

TEST_F(BackupTest, ReplacesTheWholeDatabaseWithItsLog) {
  std::string trial;
  {
    Database database({path()});
    trial = TrialStore(database).add(makeTrial({})).id;
    backUpDatabase(path(), backup());
    TrialStore(database).add(makeTrial({}));
    // As a killed process leaves it, with its log still to be written back.
    std::filesystem::copy(path(), folder_ / "killed.db");
    std::filesystem::copy(path() + "-wal", folder_ / "killed.db-wal");
  }
  restoreDatabase(backup(), folder_ / "killed.db", Existing::kReplace);
  Database database({folder_ / "killed.db"});
  const auto trials = TrialStore(database).list(kTenant, {}, {}).items;
  ASSERT_EQ(trials.size(), 1U);
  EXPECT_EQ(trials[0].id, trial);
}

TEST_F(BackupTest, ThatIsDamagedOrTooNewIsRefused) {
  {
    Database database({path()});
    tamper(database, "INSERT INTO schema_versions VALUES (999, 'from the future')");
  }
  std::filesystem::copy(path(), backup());
  EXPECT_EQ(codeOf([&] { restoreDatabase(backup(), restored(), Existing::kKeep); }),
            ErrorCode::kStorageVersion);
  folder_.write("backup.db", std::string(50'000, 'x'));
  EXPECT_EQ(codeOf([&] { restoreDatabase(backup(), restored(), Existing::kKeep); }),
            ErrorCode::kStorage);
  EXPECT_EQ(codeOf([&] { restoreDatabase(folder_ / "none", restored(), Existing::kKeep); }),
            ErrorCode::kStorage);
  EXPECT_FALSE(std::filesystem::exists(restored()));
  EXPECT_FALSE(std::filesystem::exists(restored() + ".restoring"));
}

}  // namespace
}  // namespace gaitmill

#include "service/storage/database.h"

#include <cstddef>
#include <thread>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "service/storage/migrations.h"
#include "tests/support/temporary_folder.h"

namespace gaitmill {
namespace {

ErrorCode openError(const std::string& path) {
  try {
    const Database database(path);
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::kInternal;
}

std::int64_t queryInteger(Connection& db, const char* sql) {
  Statement row = db.prepare(sql);
  row.step();
  return row.integer(0);
}

TEST(Database, IsDurableAndChecksReferences) {
  const TemporaryFolder folder;
  Database database(folder / "mill.db");
  Connection& db = database.connection();
  Statement mode = db.prepare("PRAGMA journal_mode");
  mode.step();
  EXPECT_EQ(mode.text(0), "wal");
  EXPECT_EQ(queryInteger(db, "PRAGMA synchronous"), 2) << "2 = fsync at every commit";
  EXPECT_EQ(queryInteger(db, "PRAGMA foreign_keys"), 1);
  EXPECT_THROW(db.prepare("INSERT INTO trial_files VALUES ('tri_none', 'markers', 'a', 'b')").run(),
               Error);
}

TEST(Database, HasSeenAllMigrationsOnce) {
  const TemporaryFolder folder;
  for (int opening = 0; opening < 2; ++opening) {
    Database database(folder / "mill.db");
    EXPECT_EQ(queryInteger(database.connection(), "SELECT count(*) FROM schema_versions"),
              static_cast<std::int64_t>(allMigrations().size()));
  }
}

// A database as each earlier binary left it: the first n migrations, with a row in what there is.
TEST(Database, ContinuesFromEveryEarlierVersion) {
  for (std::size_t version = 0; version <= allMigrations().size(); ++version) {
    const TemporaryFolder folder;
    {
      Connection db(folder / "mill.db");
      db.runScript(
          "CREATE TABLE schema_versions (version INTEGER PRIMARY KEY, name TEXT NOT NULL)");
      for (std::size_t i = 0; i < version; ++i) {
        db.runScript(allMigrations()[i].sql);
        db.runScript(
            ("INSERT INTO schema_versions VALUES (" + std::to_string(i + 1) + ", 'x')").c_str());
      }
      if (version > 0) {
        db.runScript("INSERT INTO trials VALUES ('tri_1', 0, 70, 1.7, NULL, '{}', '[]', '[]')");
      }
    }
    Database database(folder / "mill.db");
    EXPECT_EQ(queryInteger(database.connection(), "SELECT count(*) FROM trials"),
              version > 0 ? 1 : 0);
    EXPECT_EQ(queryInteger(database.connection(), "SELECT count(*) FROM results"), 0);
  }
}

TEST(Database, NewerThanTheBinaryIsRefused) {
  const TemporaryFolder folder;
  {
    Database database(folder / "mill.db");
    database.connection().runScript("INSERT INTO schema_versions VALUES (999, 'from the future')");
  }
  EXPECT_EQ(openError(folder / "mill.db"), ErrorCode::kStorageVersion);
}

TEST(Database, IsHeldByOneProcess) {
  const TemporaryFolder folder;
  const Database database(folder / "mill.db");
  EXPECT_EQ(openError(folder / "mill.db"), ErrorCode::kStorageInUse);
}

TEST(Database, ThatIsNoneIsRefused) {
  const TemporaryFolder folder;
  folder.write("mill.db", std::string(5000, 'x'));
  EXPECT_EQ(openError(folder / "mill.db"), ErrorCode::kStorage);
  EXPECT_EQ(openError(folder / "absent/mill.db"), ErrorCode::kStorage);
}

TEST(Database, GivesEachThreadItsOwnConnection) {
  const TemporaryFolder folder;
  Database database(folder / "mill.db");
  Connection* other = nullptr;
  std::thread([&] { other = &database.connection(); }).join();
  EXPECT_NE(&database.connection(), other);
  EXPECT_EQ(&database.connection(), &database.connection());
}

TEST(Transaction, RollsBackUnlessCommitted) {
  const TemporaryFolder folder;
  Database database(folder / "mill.db");
  Connection& db = database.connection();
  const char* insert = "INSERT INTO blobs VALUES ('a', 1, 'b')";
  {
    Transaction transaction(db, database.writers());
    db.prepare(insert).run();
  }
  EXPECT_EQ(queryInteger(db, "SELECT count(*) FROM blobs"), 0);
  {
    Transaction transaction(db, database.writers());
    db.prepare(insert).run();
    transaction.commit();
  }
  EXPECT_EQ(queryInteger(db, "SELECT count(*) FROM blobs"), 1);
}

}  // namespace
}  // namespace gaitmill

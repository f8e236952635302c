#include "service/storage/database.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstddef>
#include <utility>

#include "core/base/error.h"
#include "service/storage/migrations.h"

namespace gaitmill {

namespace {

constexpr const char* kCreateVersions =
    "CREATE TABLE IF NOT EXISTS schema_versions (version INTEGER PRIMARY KEY, name TEXT NOT NULL)";
constexpr const char* kFindVersion = "SELECT coalesce(max(version), 0) FROM schema_versions";
constexpr const char* kAddVersion = "INSERT INTO schema_versions (version, name) VALUES (?1, ?2)";

std::size_t findVersion(Connection& db) {
  Statement query = db.prepare(kFindVersion);
  query.step();
  return static_cast<std::size_t>(query.integer(0));
}

// The lock goes with the process, however it ends, so a kill leaves nothing to clean up.
int lockFile(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  require(file >= 0,
          ErrorCode::kStorage,
          "cannot create the lock file; is the folder there and writable?",
          {path, 0, 0, ""});
  if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
    ::close(file);
    throw Error(ErrorCode::kStorageInUse,
                "another gaitmill process serves this database",
                {path, 0, 0, ""});
  }
  return file;
}

}  // namespace

Database::Database(std::string path)
    : path_(std::move(path)), lock_file_(lockFile(path_ + ".lock")) {
  try {
    migrate();
  } catch (...) {
    ::close(lock_file_);
    throw;
  }
}

Database::~Database() {
  connections_.clear();
  ::close(lock_file_);
}

Connection& Database::connection() {
  const std::lock_guard<std::mutex> guard(connections_guard_);
  std::unique_ptr<Connection>& mine = connections_[std::this_thread::get_id()];
  if (!mine) {
    mine = std::make_unique<Connection>(path_);
  }
  return *mine;
}

// One transaction per step: a crash between two of them leaves a database that the next start
// continues from.
void Database::migrate() {
  Connection& db = connection();
  db.runScript(kCreateVersions);
  const auto& migrations = allMigrations();
  std::size_t version = findVersion(db);
  require(version <= migrations.size(),
          ErrorCode::kStorageVersion,
          "the database has version " + std::to_string(version) + ", this gaitmill knows " +
              std::to_string(migrations.size()) + "; use the newer gaitmill that wrote it",
          {path_, 0, 0, ""});
  for (; version < migrations.size(); ++version) {
    Transaction transaction(db, writers_);
    db.runScript(migrations[version].sql);
    db.prepare(kAddVersion)
        .bind(1, static_cast<std::int64_t>(version + 1))
        .bind(2, std::string(migrations[version].name))
        .run();
    transaction.commit();
  }
}

}  // namespace gaitmill

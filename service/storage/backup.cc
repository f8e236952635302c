#include "service/storage/backup.h"

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <memory>

#include <sqlite3.h>

#include "core/base/error.h"
#include "service/storage/dialect.h"
#include "service/storage/file_lock.h"
#include "service/storage/schema.h"
#include "service/storage/sqlite.h"
#include "service/storage/sqlite_error.h"

namespace gaitmill {

namespace {

// Pages between two reports, 4 MiB; the copy never blocks a writer, so this is no matter of locks.
constexpr int kPagesPerStep = 1024;

struct CloseHandle {
  void operator()(sqlite3* handle) const { sqlite3_close(handle); }
};
using Handle = std::unique_ptr<sqlite3, CloseHandle>;

Handle openHandle(const std::string& path, int flags) {
  sqlite3* raw = nullptr;
  const int result = sqlite3_open_v2(path.c_str(), &raw, flags | SQLITE_OPEN_NOMUTEX, nullptr);
  Handle handle(raw);
  if (result != SQLITE_OK) {
    throwSqliteError(raw, "opening " + path);
  }
  sqlite3_extended_result_codes(raw, 1);
  sqlite3_busy_timeout(raw, 10'000);
  return handle;
}

void run(sqlite3* handle, const char* sql) {
  if (sqlite3_exec(handle, sql, nullptr, nullptr, nullptr) != SQLITE_OK) {
    throwSqliteError(handle, sql);
  }
}

// The source is held in one read transaction: writers go on, and the copy is of one instant.
void copyPages(sqlite3* from, sqlite3* to, const BackupProgress& progress) {
  run(from, "BEGIN; SELECT count(*) FROM sqlite_schema");
  sqlite3_backup* copy = sqlite3_backup_init(to, "main", from, "main");
  if (copy == nullptr) {
    throwSqliteError(to, "beginning the copy");
  }
  int result = SQLITE_OK;
  while (result == SQLITE_OK) {
    result = sqlite3_backup_step(copy, kPagesPerStep);
    const std::int64_t all = sqlite3_backup_pagecount(copy);
    if (progress) {
      progress(all - sqlite3_backup_remaining(copy), all);
    }
  }
  if (sqlite3_backup_finish(copy) != SQLITE_OK || result != SQLITE_DONE) {
    throwSqliteError(to, "copying the database");
  }
  run(from, "COMMIT");
}

void syncPath(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool ok = file >= 0 && ::fsync(file) == 0;
  if (file >= 0) {
    ::close(file);
  }
  require(ok, ErrorCode::kStorage, "cannot sync the copy to the disk", {path});
}

std::string folderOf(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

// Of a finished copy: it must be whole, and of a version that this binary knows.
void requireWhole(const std::string& path) {
  const std::unique_ptr<Connection> db = openSqlite({path, "", 0});
  {
    Statement rows = db->prepare(dialect::kCheckIntegrity);
    rows.step();
    require(rows.text(0) == "ok",
            ErrorCode::kStorage,
            "the database is damaged: " + rows.text(0),
            {path});
  }
  requireKnownVersion(*db, path);
}

// -wal and -shm belong to a database by name alone: left behind, they would be taken for the logs
// of whatever stands there next.
void removeLogs(const std::string& path) {
  for (const char* suffix : {"-wal", "-shm", "-journal"}) {
    std::error_code absent;
    std::filesystem::remove(path + suffix, absent);
  }
}

void removeCopy(const std::string& path) {
  std::error_code absent;
  std::filesystem::remove(path, absent);
  removeLogs(path);
}

void createPrivately(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  require(file >= 0,
          ErrorCode::kStorage,
          "cannot create the copy; is the folder there and writable?",
          {path});
  ::close(file);
}

// A private, complete, checked and synced copy under a name of its own.
void makeCopy(const std::string& from, const std::string& to, const BackupProgress& progress) {
  removeCopy(to);
  createPrivately(to);
  {
    const Handle source = openHandle(from, SQLITE_OPEN_READWRITE);
    const Handle target = openHandle(to, SQLITE_OPEN_READWRITE);
    copyPages(source.get(), target.get(), progress);
    run(target.get(), "PRAGMA journal_mode = DELETE");
  }
  requireWhole(to);
  removeLogs(to);
  syncPath(to);
}

void copyAndRename(const std::string& from,
                   const std::string& temporary,
                   const std::string& to,
                   const BackupProgress& progress) {
  try {
    makeCopy(from, temporary, progress);
    removeLogs(to);
    std::filesystem::rename(temporary, to);
    syncPath(folderOf(to));
  } catch (const std::filesystem::filesystem_error& error) {
    removeCopy(temporary);
    throw Error(ErrorCode::kStorage, error.code().message(), {to});
  } catch (...) {
    removeCopy(temporary);
    throw;
  }
}

void requireExists(const std::string& path) {
  require(std::filesystem::is_regular_file(path),
          ErrorCode::kStorage,
          "there is no database file",
          {path});
}

}  // namespace

void backUpDatabase(const std::string& path,
                    const std::string& target,
                    const BackupProgress& progress) {
  requireExists(path);
  require(!std::filesystem::exists(target) || !std::filesystem::equivalent(path, target),
          ErrorCode::kStorage,
          "a backup cannot take the place of its own database",
          {target});
  const FileLock using_it(
      usingLockPath(path), LockMode::kShared, "this database is being restored");
  copyAndRename(path, target + ".partial", target, progress);
}

void restoreDatabase(const std::string& backup, const std::string& path, Existing existing) {
  requireExists(backup);
  const FileLock serving(
      servingLockPath(path), LockMode::kExclusive, "a gaitmill process serves this database");
  const FileLock using_it(
      usingLockPath(path), LockMode::kExclusive, "a gaitmill process uses this database");
  require(existing == Existing::kReplace || !std::filesystem::exists(path),
          ErrorCode::kStorageInUse,
          "there is a database already; say that it is to be replaced",
          {path});
  copyAndRename(backup, path + ".restoring", path, {});
}

}  // namespace gaitmill

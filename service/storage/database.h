#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "service/storage/connection.h"

namespace gaitmill {

class GroupCommit;
class FileLock;

/// Who opens a database file.
enum class DatabaseUse {
  kServe,  ///< the one service of this file; a second one is refused
  kWork,   ///< further processes that run jobs or read, next to the service or without it
};

struct DatabaseOptions {
  std::string path;
  DatabaseUse use = DatabaseUse::kServe;
  std::int64_t max_size = 0;  ///< [bytes] the file may grow to; 0 = as large as the disk
  /// [bytes] that uploads leave free on the disk, so that running jobs can still be finished.
  std::int64_t free_floor = std::int64_t{64} << 20;
  std::string vfs{};  ///< the file layer by its SQLite name; empty = the usual one
};

/// A consistent view of the database for one thread, for as long as it lives: keep it short.
/// Borrows a connection from the database's pool.
class ReadTransaction {
 public:
  ReadTransaction(ReadTransaction&& other) noexcept;
  ~ReadTransaction();
  ReadTransaction(const ReadTransaction&) = delete;
  ReadTransaction& operator=(const ReadTransaction&) = delete;
  ReadTransaction& operator=(ReadTransaction&&) = delete;

  Connection& operator*() const { return *connection_; }
  Connection* operator->() const { return connection_.get(); }

 private:
  friend class Database;
  ReadTransaction(class Database& database, std::unique_ptr<Connection> connection);

  Database* database_;
  std::unique_ptr<Connection> connection_;
};

/// The database file, brought to this binary's shape when it is opened. Reads go on at any time
/// from any thread. Writes are closures that one thread of the database runs, many of them in one
/// transaction, so that one fsync makes a whole batch durable (group commit).
class Database {
 public:
  /// @throws Error kStorageInUse if another process serves this file, or a restore is replacing it;
  ///         kStorageVersion if a newer gaitmill has changed its shape; kStorage; kStorageFull
  explicit Database(DatabaseOptions options);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  ReadTransaction read();

  /// Runs `work(connection)` and returns its result once it is durable. If it throws, its own
  /// changes are undone and the error comes back; its neighbours in the batch go on. If the commit
  /// fails, every caller of the batch gets that error and nothing has happened. Hold no lock, read
  /// transaction or statement while calling it, and never call it from within `work`.
  /// @throws Error kStorage, kStorageFull, and whatever `work` throws
  template <class Work>
  std::invoke_result_t<Work, Connection&> write(Work work) {
    return runAs<Work>(Weight::kSmall, std::move(work));
  }
  /// The same in a transaction of its own, for megabytes at a time: small writes overtake it.
  template <class Work>
  std::invoke_result_t<Work, Connection&> writeBulk(Work work) {
    return runAs<Work>(Weight::kBulk, std::move(work));
  }

  /// Takes deleted bytes off the disk: they are overwritten in the file, and the log that may still
  /// hold them is emptied. Waits for that, at most two seconds while readers stand in the way; it
  /// then happens as soon as they have gone. @returns whether it has happened
  bool wipeDeleted();

  /// For uploads. @throws Error kStorageFull if `size` more bytes would not leave the floor free
  void requireRoom(std::uint64_t size) const;
  /// Empty if jobs and uploads can be stored, else why not: for readiness.
  std::string findShortage() const;

  /// Of the file with its log [bytes].
  std::int64_t findSize() const;
  /// Reads everything. @returns "ok" or the first fault
  std::string checkIntegrity();

  const DatabaseOptions& options() const { return options_; }
  const std::string& path() const { return options_.path; }

 private:
  friend class ReadTransaction;
  enum class Weight { kSmall, kBulk };

  std::unique_ptr<Connection> open() const;
  void giveBack(std::unique_ptr<Connection> connection) noexcept;
  void runWrite(Weight weight, const std::function<void(Connection&)>& work);

  template <class Work>
  std::invoke_result_t<Work, Connection&> runAs(Weight weight, Work work) {
    using Result = std::invoke_result_t<Work, Connection&>;
    if constexpr (std::is_void_v<Result>) {
      runWrite(weight, [&work](Connection& db) { work(db); });
    } else {
      std::optional<Result> result;
      runWrite(weight, [&work, &result](Connection& db) { result.emplace(work(db)); });
      return std::move(*result);
    }
  }

  DatabaseOptions options_;
  std::unique_ptr<FileLock> serving_;
  std::unique_ptr<FileLock> using_;
  std::mutex pool_guard_;
  std::vector<std::unique_ptr<Connection>> pool_;
  std::unique_ptr<GroupCommit> writer_;
};

}  // namespace gaitmill

#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "service/storage/sqlite.h"

namespace gaitmill {

/// The database file: one connection per thread, brought to this binary's shape when it is opened,
/// and held by one process at a time.
class Database {
 public:
  /// @throws Error kStorageInUse if another process serves this file; kStorageVersion if a newer
  ///         binary has changed its shape; kStorage
  explicit Database(std::string path);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// The calling thread's own connection.
  Connection& connection();
  /// Taken by Transaction.
  std::mutex& writers() { return writers_; }
  const std::string& path() const { return path_; }

 private:
  void migrate();

  std::string path_;
  int lock_file_ = -1;
  std::mutex writers_;
  std::mutex connections_guard_;
  std::map<std::thread::id, std::unique_ptr<Connection>> connections_;
};

}  // namespace gaitmill

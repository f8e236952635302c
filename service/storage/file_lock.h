#pragma once

#include <string>

namespace gaitmill {

enum class LockMode { kShared, kExclusive };

/// A lock on a file for as long as the object lives. It goes with the process, however that ends,
/// so a kill leaves nothing to clean up.
class FileLock {
 public:
  /// Waits half a second at most, for a holder that is just going.
  /// @throws Error kStorageInUse with `refusal` if another holder stays in the way; kStorage if the
  ///         file cannot be made
  FileLock(const std::string& path, LockMode mode, const std::string& refusal);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int file_;
};

/// Beside the database `path`: held exclusively by the one service of it.
std::string servingLockPath(const std::string& path);
/// Shared by every process that uses the database, held exclusively by a restore.
std::string usingLockPath(const std::string& path);

}  // namespace gaitmill

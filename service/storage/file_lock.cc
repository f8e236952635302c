#include "service/storage/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "core/base/error.h"

namespace gaitmill {

FileLock::FileLock(const std::string& path, LockMode mode, const std::string& refusal)
    : file_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {
  require(file_ >= 0,
          ErrorCode::kStorage,
          "cannot create the lock file; is the folder there and writable?",
          {path});
  const int operation = (mode == LockMode::kShared ? LOCK_SH : LOCK_EX) | LOCK_NB;
  if (::flock(file_, operation) != 0) {
    ::close(file_);
    throw Error(ErrorCode::kStorageInUse, refusal, {path});
  }
}

FileLock::~FileLock() {
  ::close(file_);
}

std::string servingLockPath(const std::string& path) {
  return path + ".lock";
}

std::string usingLockPath(const std::string& path) {
  return path + ".users";
}

}  // namespace gaitmill

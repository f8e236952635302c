#include "service/storage/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "core/base/error.h"

namespace gaitmill {

namespace {

// A process killed in the middle of starting a child leaves its locks with the child until that has
// become another program: some milliseconds, longer on a busy machine.
constexpr std::chrono::milliseconds kPatience{500};
constexpr std::chrono::milliseconds kPause{10};

bool tryLock(int file, int operation) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (::flock(file, operation | LOCK_NB) != 0) {
    if (std::chrono::steady_clock::now() >= deadline) {
      return false;
    }
    std::this_thread::sleep_for(kPause);
  }
  return true;
}

}  // namespace

FileLock::FileLock(const std::string& path, LockMode mode, const std::string& refusal)
    : file_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {
  require(file_ >= 0,
          ErrorCode::kStorage,
          "cannot create the lock file; is the folder there and writable?",
          {path});
  if (!tryLock(file_, mode == LockMode::kShared ? LOCK_SH : LOCK_EX)) {
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

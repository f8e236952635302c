#include "service/storage/file_lock.h"

#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/temporary_folder.h"

namespace gaitmill {
namespace {

TEST(FileLock, HolderThatStaysIsToldOf) {
  const TemporaryFolder folder;
  const FileLock held(folder / "lock", LockMode::kExclusive, "first");
  try {
    const FileLock second(folder / "lock", LockMode::kExclusive, "it is taken");
    FAIL() << "two holders";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kStorageInUse);
    EXPECT_EQ(error.message(), "it is taken");
    EXPECT_EQ(error.where().file, folder / "lock");
  }
}

TEST(FileLock, SharedHoldersDoNotStandInEachOthersWay) {
  const TemporaryFolder folder;
  const FileLock first(folder / "lock", LockMode::kShared, "first");
  EXPECT_NO_THROW(FileLock(folder / "lock", LockMode::kShared, "second"));
  EXPECT_THROW(FileLock(folder / "lock", LockMode::kExclusive, "third"), Error);
}

TEST(FileLock, HolderThatGoesIsWaitedFor) {
  const TemporaryFolder folder;
  auto held = std::make_unique<FileLock>(folder / "lock", LockMode::kExclusive, "first");
  std::thread going([&held] { held.reset(); });
  EXPECT_NO_THROW(FileLock(folder / "lock", LockMode::kExclusive, "second"));
  going.join();
}

}  // namespace
}  // namespace gaitmill

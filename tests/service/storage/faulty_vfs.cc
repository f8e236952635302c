#include "tests/service/storage/faulty_vfs.h"

#include <mutex>

#include <sqlite3.h>

namespace gaitmill {

namespace {

constexpr const char* kName = "gaitmill_faulty";

struct Plan {
  std::mutex guard;
  int operations = 0;
  int fail_at = 0;  ///< 0 = never
  DiskFault fault = DiskFault::kInputOutput;
  FaultLasts lasts = FaultLasts::kOnce;
};

Plan& plan() {
  static Plan the_plan;
  return the_plan;
}

// SQLITE_OK, or what this operation fails with.
int nextOutcome(int io_error) {
  Plan& p = plan();
  const std::lock_guard<std::mutex> lock(p.guard);
  ++p.operations;
  const bool fails = p.fail_at > 0 && (p.lasts == FaultLasts::kOnce ? p.operations == p.fail_at
                                                                    : p.operations >= p.fail_at);
  if (!fails) {
    return SQLITE_OK;
  }
  return p.fault == DiskFault::kFull ? SQLITE_FULL : io_error;
}

// SQLite allocates szOsFile bytes for each file: this, and the real file behind it.
struct FaultyFile {
  sqlite3_file base;
  sqlite3_file* real;
};

sqlite3_file* realOf(sqlite3_file* file) {
  return reinterpret_cast<FaultyFile*>(file)->real;
}

sqlite3_vfs* realVfs() {
  static sqlite3_vfs* vfs = sqlite3_vfs_find(nullptr);
  return vfs;
}

int closeFile(sqlite3_file* file) {
  return realOf(file)->pMethods->xClose(realOf(file));
}
int readFile(sqlite3_file* file, void* bytes, int size, sqlite3_int64 offset) {
  return realOf(file)->pMethods->xRead(realOf(file), bytes, size, offset);
}
int writeFile(sqlite3_file* file, const void* bytes, int size, sqlite3_int64 offset) {
  const int outcome = nextOutcome(SQLITE_IOERR_WRITE);
  const int written = outcome == SQLITE_OK ? size : size / 2;
  const int result = realOf(file)->pMethods->xWrite(realOf(file), bytes, written, offset);
  return outcome == SQLITE_OK ? result : outcome;
}
int truncateFile(sqlite3_file* file, sqlite3_int64 size) {
  const int outcome = nextOutcome(SQLITE_IOERR_TRUNCATE);
  return outcome == SQLITE_OK ? realOf(file)->pMethods->xTruncate(realOf(file), size) : outcome;
}
// Nothing is synced: no test turns the power off, and thousands of fsyncs take minutes.
int syncFile(sqlite3_file*, int) {
  return nextOutcome(SQLITE_IOERR_FSYNC);
}
int sizeOfFile(sqlite3_file* file, sqlite3_int64* size) {
  return realOf(file)->pMethods->xFileSize(realOf(file), size);
}
int lockFile(sqlite3_file* file, int level) {
  return realOf(file)->pMethods->xLock(realOf(file), level);
}
int unlockFile(sqlite3_file* file, int level) {
  return realOf(file)->pMethods->xUnlock(realOf(file), level);
}
int checkLock(sqlite3_file* file, int* is_locked) {
  return realOf(file)->pMethods->xCheckReservedLock(realOf(file), is_locked);
}
int controlFile(sqlite3_file* file, int operation, void* argument) {
  return realOf(file)->pMethods->xFileControl(realOf(file), operation, argument);
}
int sectorSize(sqlite3_file* file) {
  return realOf(file)->pMethods->xSectorSize(realOf(file));
}
int characteristics(sqlite3_file* file) {
  return realOf(file)->pMethods->xDeviceCharacteristics(realOf(file));
}
int mapShared(sqlite3_file* file, int page, int size, int extend, void volatile** where) {
  return realOf(file)->pMethods->xShmMap(realOf(file), page, size, extend, where);
}
int lockShared(sqlite3_file* file, int offset, int count, int flags) {
  return realOf(file)->pMethods->xShmLock(realOf(file), offset, count, flags);
}
void sharedBarrier(sqlite3_file* file) {
  realOf(file)->pMethods->xShmBarrier(realOf(file));
}
int unmapShared(sqlite3_file* file, int remove) {
  return realOf(file)->pMethods->xShmUnmap(realOf(file), remove);
}

const sqlite3_io_methods& faultyMethods() {
  static const sqlite3_io_methods methods = [] {
    sqlite3_io_methods m{};
    m.iVersion = 2;
    m.xClose = closeFile;
    m.xRead = readFile;
    m.xWrite = writeFile;
    m.xTruncate = truncateFile;
    m.xSync = syncFile;
    m.xFileSize = sizeOfFile;
    m.xLock = lockFile;
    m.xUnlock = unlockFile;
    m.xCheckReservedLock = checkLock;
    m.xFileControl = controlFile;
    m.xSectorSize = sectorSize;
    m.xDeviceCharacteristics = characteristics;
    m.xShmMap = mapShared;
    m.xShmLock = lockShared;
    m.xShmBarrier = sharedBarrier;
    m.xShmUnmap = unmapShared;
    return m;
  }();
  return methods;
}

int openFile(sqlite3_vfs*, const char* path, sqlite3_file* file, int flags, int* out_flags) {
  auto* faulty = reinterpret_cast<FaultyFile*>(file);
  faulty->base.pMethods = nullptr;
  faulty->real = reinterpret_cast<sqlite3_file*>(faulty + 1);
  const int outcome = nextOutcome(SQLITE_CANTOPEN);
  if (outcome != SQLITE_OK) {
    return outcome;
  }
  const int result = realVfs()->xOpen(realVfs(), path, faulty->real, flags, out_flags);
  if (faulty->real->pMethods != nullptr) {
    faulty->base.pMethods = &faultyMethods();
  }
  return result;
}

sqlite3_vfs& faultyVfs() {
  static sqlite3_vfs vfs = [] {
    sqlite3_vfs copy = *realVfs();
    copy.pNext = nullptr;
    copy.zName = kName;
    copy.szOsFile = static_cast<int>(sizeof(FaultyFile)) + realVfs()->szOsFile;
    copy.xOpen = openFile;
    return copy;
  }();
  return vfs;
}

}  // namespace

const char* FaultyVfs::name() {
  static const int registered = sqlite3_vfs_register(&faultyVfs(), 0);
  return registered == SQLITE_OK ? kName : "";
}

void FaultyVfs::failAt(int operation, DiskFault fault, FaultLasts lasts) {
  Plan& p = plan();
  const std::lock_guard<std::mutex> lock(p.guard);
  p.operations = 0;
  p.fail_at = operation;
  p.fault = fault;
  p.lasts = lasts;
}

void FaultyVfs::heal() {
  failAt(0, DiskFault::kInputOutput, FaultLasts::kOnce);
}

int FaultyVfs::countOperations() {
  Plan& p = plan();
  const std::lock_guard<std::mutex> lock(p.guard);
  return p.operations;
}

}  // namespace gaitmill

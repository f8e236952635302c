#include "service/storage/database.h"

#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <utility>

#include "core/base/error.h"
#include "service/storage/dialect.h"
#include "service/storage/file_lock.h"
#include "service/storage/group_commit.h"
#include "service/storage/schema.h"
#include "service/storage/sqlite.h"

namespace gaitmill {

namespace {

constexpr std::chrono::milliseconds kWipeLimit{2'000};
constexpr std::size_t kPooledConnections = 8;
constexpr std::int64_t kMebibyte = std::int64_t{1} << 20;

std::unique_ptr<FileLock> lockForServing(const DatabaseOptions& options) {
  if (options.use != DatabaseUse::kServe) {
    return nullptr;
  }
  return std::make_unique<FileLock>(servingLockPath(options.path),
                                    LockMode::kExclusive,
                                    "another gaitmill process serves this database");
}

std::unique_ptr<FileLock> lockForUsing(const DatabaseOptions& options) {
  return std::make_unique<FileLock>(
      usingLockPath(options.path), LockMode::kShared, "this database is being restored");
}

// The file holds people's movements: nobody else's eyes. Its log inherits the mode.
void createPrivately(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  require(file >= 0,
          ErrorCode::kStorage,
          "cannot open the database; is the folder there and writable?",
          {path});
  ::close(file);
}

std::string folderOf(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

std::int64_t findFreeBytes(const std::string& path) {
  struct statvfs volume {};
  require(::statvfs(folderOf(path).c_str(), &volume) == 0,
          ErrorCode::kStorage,
          "cannot ask for the free space on the disk",
          {path});
  return static_cast<std::int64_t>(volume.f_bavail * volume.f_frsize);
}

}  // namespace

ReadTransaction::ReadTransaction(Database& database, std::unique_ptr<Connection> connection)
    : database_(&database), connection_(std::move(connection)) {
  connection_->prepare(dialect::kBeginRead).run();
}

ReadTransaction::ReadTransaction(ReadTransaction&& other) noexcept = default;

ReadTransaction::~ReadTransaction() {
  if (connection_ == nullptr) {
    return;
  }
  try {
    connection_->prepare(dialect::kCommit).run();
    database_->giveBack(std::move(connection_));
  } catch (const Error&) {
    connection_.reset();  // closing it ends the read as well
  }
}

Database::Database(DatabaseOptions options)
    : options_(std::move(options)),
      serving_(lockForServing(options_)),
      using_(lockForUsing(options_)) {
  createPrivately(options_.path);
  std::unique_ptr<Connection> connection = open();
  migrateDatabase(*connection, options_.path);
  writer_ = std::make_unique<GroupCommit>(std::move(connection));
}

Database::~Database() {
  writer_.reset();
  pool_.clear();
}

std::unique_ptr<Connection> Database::open() const {
  return openSqlite({options_.path, options_.vfs, options_.max_size});
}

ReadTransaction Database::read() {
  std::unique_ptr<Connection> connection;
  {
    const std::lock_guard<std::mutex> lock(pool_guard_);
    if (!pool_.empty()) {
      connection = std::move(pool_.back());
      pool_.pop_back();
    }
  }
  return {*this, connection ? std::move(connection) : open()};
}

void Database::giveBack(std::unique_ptr<Connection> connection) noexcept {
  const std::lock_guard<std::mutex> lock(pool_guard_);
  if (pool_.size() < kPooledConnections) {
    pool_.push_back(std::move(connection));
  }
}

void Database::runWrite(Weight weight, const std::function<void(Connection&)>& work) {
  if (weight == Weight::kBulk) {
    writer_->runBulk(work);
  } else {
    writer_->run(work);
  }
}

bool Database::wipeDeleted() {
  return writer_->wipe(kWipeLimit);
}

void Database::requireRoom(std::uint64_t size) const {
  const std::int64_t left = findFreeBytes(options_.path) - static_cast<std::int64_t>(size);
  require(left >= options_.free_floor,
          ErrorCode::kStorageFull,
          "the disk has no room for " + std::to_string(size) + " more bytes",
          {"", 0, 0, "body"});
}

std::string Database::findShortage() const {
  const std::int64_t left = findFreeBytes(options_.path);
  if (left < options_.free_floor) {
    return "the disk of the database has only " + std::to_string(left / kMebibyte) + " MiB left";
  }
  const std::string failure = writer_->findFailure();
  return failure.empty() ? failure : "the last write failed: " + failure;
}

std::int64_t Database::findSize() const {
  std::int64_t size = 0;
  for (const char* suffix : {"", "-wal"}) {
    std::error_code absent;
    const auto part = std::filesystem::file_size(options_.path + suffix, absent);
    size += absent ? 0 : static_cast<std::int64_t>(part);
  }
  return size;
}

std::string Database::checkIntegrity() {
  const ReadTransaction db = read();
  Statement rows = db->prepare(dialect::kCheckIntegrity);
  rows.step();
  return rows.text(0);
}

}  // namespace gaitmill

#include "api/body_store.h"

#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <utility>

#include "core/base/error.h"

namespace gaitmill::api {

namespace {

[[noreturn]] void throwFileError(const std::string& what, int fault) {
  const bool is_full = fault == ENOSPC || fault == EDQUOT;
  throw Error(
      is_full ? ErrorCode::kStorageFull : ErrorCode::kStorage,
      is_full ? "there is no room on the disk for the body" : what + ": " + std::strerror(fault),
      {"", 0, 0, "body"});
}

class MemorySource : public ByteSource {
 public:
  MemorySource(std::string bytes, Lease lease)
      : bytes_(std::move(bytes)), lease_(std::move(lease)) {}

  std::uint64_t size() const override { return bytes_.size(); }
  std::string read(std::uint64_t offset, std::size_t size) const override {
    return offset < bytes_.size() ? bytes_.substr(static_cast<std::size_t>(offset), size) : "";
  }

 private:
  std::string bytes_;
  Lease lease_;
};

class MemoryBuffer : public BodyBuffer {
 public:
  explicit MemoryBuffer(Lease lease) : lease_(std::move(lease)) {}

  bool isOnDisk() const override { return false; }
  void append(std::string_view bytes) override { bytes_.append(bytes); }
  std::shared_ptr<const ByteSource> finish() override {
    return std::make_shared<MemorySource>(std::move(bytes_), std::move(lease_));
  }

 private:
  std::string bytes_;
  Lease lease_;
};

// A file without a name.
class SpoolFile {
 public:
  explicit SpoolFile(const std::string& folder)
      : descriptor_(::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, S_IRUSR | S_IWUSR)) {
    if (descriptor_ < 0 && (errno == EOPNOTSUPP || errno == EISDIR)) {
      openAndUnlink(folder);
    }
    if (descriptor_ < 0) {
      throwFileError("cannot open a spool file in " + folder, errno);
    }
  }
  ~SpoolFile() {
    if (descriptor_ >= 0) {
      ::close(descriptor_);
    }
  }
  SpoolFile(SpoolFile&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  SpoolFile(const SpoolFile&) = delete;
  SpoolFile& operator=(const SpoolFile&) = delete;

  void append(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno != EINTR) {
        throwFileError("cannot write the spool file", errno);
      }
      bytes.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
    }
  }
  std::string read(std::uint64_t offset, std::size_t size) const {
    std::string bytes(size, '\0');
    std::size_t count = 0;
    while (count < size) {
      const ssize_t got = ::pread(
          descriptor_, bytes.data() + count, size - count, static_cast<off_t>(offset + count));
      if (got < 0 && errno != EINTR) {
        throwFileError("cannot read the spool file", errno);
      }
      if (got == 0) {
        break;
      }
      count += static_cast<std::size_t>(std::max<ssize_t>(got, 0));
    }
    bytes.resize(count);
    return bytes;
  }

 private:
  // For file systems without O_TMPFILE.
  void openAndUnlink(const std::string& folder) {
    std::string path = folder + "/gaitmill-spool-XXXXXX";
    descriptor_ = ::mkostemp(path.data(), O_CLOEXEC);
    if (descriptor_ >= 0) {
      ::unlink(path.c_str());
    }
  }

  int descriptor_;
};

class SpoolSource : public ByteSource {
 public:
  SpoolSource(SpoolFile file, std::uint64_t size, Lease lease)
      : file_(std::move(file)), size_(size), lease_(std::move(lease)) {}

  std::uint64_t size() const override { return size_; }
  std::string read(std::uint64_t offset, std::size_t size) const override {
    if (offset >= size_) {
      return "";
    }
    const std::uint64_t count = std::min<std::uint64_t>(size, size_ - offset);
    return file_.read(offset, static_cast<std::size_t>(count));
  }

 private:
  SpoolFile file_;
  std::uint64_t size_;
  Lease lease_;
};

// Opens its file with the first bytes: that may wait for the disk's journal, and append() is called
// where waiting is allowed.
class SpoolBuffer : public BodyBuffer {
 public:
  SpoolBuffer(std::string folder, Lease lease)
      : folder_(std::move(folder)), lease_(std::move(lease)) {}

  bool isOnDisk() const override { return true; }
  void append(std::string_view bytes) override {
    if (!file_) {
      file_.emplace(folder_);
    }
    file_->append(bytes);
    size_ += bytes.size();
  }
  std::shared_ptr<const ByteSource> finish() override {
    check(file_.has_value(), "a spooled body has no bytes");
    return std::make_shared<SpoolSource>(std::move(*file_), size_, std::move(lease_));
  }

 private:
  std::string folder_;
  std::optional<SpoolFile> file_;
  std::uint64_t size_ = 0;
  Lease lease_;
};

}  // namespace

Lease::Lease(std::shared_ptr<std::atomic<std::uint64_t>> used, std::uint64_t bytes)
    : used_(std::move(used)), bytes_(bytes) {}

Lease::~Lease() {
  if (used_) {
    *used_ -= bytes_;
  }
}

Lease::Lease(Lease&& other) noexcept
    : used_(std::exchange(other.used_, nullptr)), bytes_(other.bytes_) {}

Lease& Lease::operator=(Lease&& other) noexcept {
  std::swap(used_, other.used_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

Budget::Budget(std::uint64_t limit)
    : used_(std::make_shared<std::atomic<std::uint64_t>>(0)), limit_(limit) {}

Lease Budget::take(std::uint64_t bytes) {
  if (bytes > limit_ || *used_ > limit_ - bytes) {
    return {};
  }
  *used_ += bytes;
  return {used_, bytes};
}

BodyStore::BodyStore(const ServerOptions& options)
    : options_(options), memory_(options.max_body_memory), spool_(options.max_spool_bytes) {}

std::unique_ptr<BodyBuffer> BodyStore::open(std::uint64_t length) {
  if (length <= options_.spool_above) {
    if (Lease lease = memory_.take(length)) {
      return std::make_unique<MemoryBuffer>(std::move(lease));
    }
  }
  Lease lease = spool_.take(length);
  require(static_cast<bool>(lease),
          ErrorCode::kRequestBusy,
          "other uploads use all the room that there is for bodies; try again later",
          {"", 0, 0, "body"});
  requireFreeSpace(length);
  return std::make_unique<SpoolBuffer>(options_.spool_folder, std::move(lease));
}

void BodyStore::requireFreeSpace(std::uint64_t length) const {
  struct statvfs disk {};
  if (::statvfs(options_.spool_folder.c_str(), &disk) != 0) {
    throwFileError("cannot read the spool folder " + options_.spool_folder, errno);
  }
  const std::uint64_t free = disk.f_bavail * disk.f_frsize;
  require(free >= length && free - length >= options_.spool_free_bytes,
          ErrorCode::kStorageFull,
          "there is no room on the disk for the body",
          {"", 0, 0, "body"});
}

}  // namespace gaitmill::api

#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "api/http.h"
#include "api/server.h"

namespace gaitmill::api {

/// A share of a bounded amount of bytes, given back when it ends. Outlives its budget safely.
class Lease {
 public:
  Lease() = default;
  Lease(std::shared_ptr<std::atomic<std::uint64_t>> used, std::uint64_t bytes);
  ~Lease();
  Lease(Lease&& other) noexcept;
  Lease& operator=(Lease&& other) noexcept;
  Lease(const Lease&) = delete;
  Lease& operator=(const Lease&) = delete;

  explicit operator bool() const { return used_ != nullptr; }

 private:
  std::shared_ptr<std::atomic<std::uint64_t>> used_;
  std::uint64_t bytes_ = 0;
};

/// Hands out leases on at most `limit` bytes at a time. Leases are taken on one thread and may end
/// on any.
class Budget {
 public:
  explicit Budget(std::uint64_t limit);
  /// @returns an empty lease if not so much is left
  Lease take(std::uint64_t bytes);

 private:
  std::shared_ptr<std::atomic<std::uint64_t>> used_;
  std::uint64_t limit_;
};

/// A body being received, in memory or in an unlinked file.
class BodyBuffer {
 public:
  virtual ~BodyBuffer() = default;
  /// Whether append() and the end of the buffer may wait for a disk.
  virtual bool isOnDisk() const = 0;
  /// @throws Error kStorageFull, kStorage
  virtual void append(std::string_view bytes) = 0;
  /// What was appended; the buffer is spent.
  virtual std::shared_ptr<const ByteSource> finish() = 0;
};

/// Decides where bodies go: short ones to memory while its budget lasts, all others to the spool
/// folder, whose files have no name and vanish with their last reader, even when we are killed.
class BodyStore {
 public:
  explicit BodyStore(const ServerOptions& options);
  /// Room for a body of `length` bytes.
  /// @throws Error kRequestBusy if the spool's budget is used up; kStorageFull if the disk is
  std::unique_ptr<BodyBuffer> open(std::uint64_t length);

 private:
  void requireFreeSpace(std::uint64_t length) const;

  const ServerOptions& options_;
  Budget memory_;
  Budget spool_;
};

}  // namespace gaitmill::api

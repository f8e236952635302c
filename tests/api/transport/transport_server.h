#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "api/server.h"
#include "core/base/error.h"
#include "tests/http/raw_client.h"

namespace gaitmill::api {

inline constexpr std::uint64_t kLargeBytes = 8'000'000;

/// Byte at this place of every large body of these tests.
inline char patternByte(std::uint64_t at) {
  return static_cast<char>('a' + (at * 2654435761U >> 7U) % 26);
}

inline std::string makePattern(std::uint64_t offset, std::size_t size) {
  std::string bytes(size, '\0');
  for (std::size_t i = 0; i < size; ++i) {
    bytes[i] = patternByte(offset + i);
  }
  return bytes;
}

/// A large stored file that exists only as a formula.
class PatternSource : public ByteSource {
 public:
  explicit PatternSource(std::uint64_t size) : size_(size) {}
  std::uint64_t size() const override { return size_; }
  std::string read(std::uint64_t offset, std::size_t size) const override {
    const std::uint64_t left = offset < size_ ? size_ - offset : 0;
    return makePattern(offset, static_cast<std::size_t>(std::min<std::uint64_t>(left, size)));
  }

 private:
  std::uint64_t size_;
};

/// Holds handlers back until a test lets them go.
class Latch {
 public:
  void wait() {
    std::unique_lock lock(mutex_);
    ++waiting_;
    changed_.notify_all();
    changed_.wait(lock, [this] { return open_; });
  }
  void open() {
    const std::lock_guard lock(mutex_);
    open_ = true;
    changed_.notify_all();
  }
  void awaitWaiting(int count) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return waiting_ >= count; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int waiting_ = 0;
  bool open_ = false;
};

/// What the routes of the test server share with the tests.
struct TransportState {
  std::atomic<int> calls{0};  ///< of routes that a hostile request must not reach
  std::atomic<int> asked{0};  ///< times a parked request or stream was asked
  std::atomic<bool> is_final{false};
  Latch latch;
  std::mutex mutex;
  std::deque<std::string> events;
  std::vector<RequestRecord> records;
  std::vector<std::string> errors;

  void addEvent(const std::string& event) {
    const std::lock_guard lock(mutex);
    events.push_back(event);
  }
};

/// A server with stub routes behind a real socket.
class TransportServer {
 public:
  explicit TransportServer(ServerOptions options);
  ~TransportServer();
  TransportServer(const TransportServer&) = delete;
  TransportServer& operator=(const TransportServer&) = delete;

  int port() const { return port_; }
  Server& server() { return *server_; }
  TransportState& state() { return state_; }
  /// Ends it and waits for the end.
  void stop();
  RawReply ask(const std::string& request) const;
  /// Waits until the load is as wanted, at most ten seconds.
  bool awaitLoad(const std::function<bool(const ServerLoad&)>& is_wanted) const;

 private:
  TransportState state_;
  std::unique_ptr<Server> server_;
  std::thread thread_;
  int port_ = 0;
};

std::vector<Route> makeTransportRoutes(TransportState& state);

class TransportTest : public ::testing::Test {
 protected:
  void start(ServerOptions options = {}) {
    server_ = std::make_unique<TransportServer>(std::move(options));
  }
  TransportServer& server() { return *server_; }
  TransportState& state() { return server_->state(); }
  RawClient connect() const { return RawClient(server_->port()); }
  RawReply ask(const std::string& request) const { return server_->ask(request); }

 private:
  std::unique_ptr<TransportServer> server_;
};

}  // namespace gaitmill::api

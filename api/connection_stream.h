#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include <httplib.h>

#include "api/server.h"

namespace gaitmill::api {

/// One connection as cpp-httplib reads and writes it, with what its own stream lacks: a deadline
/// for a whole request instead of a time-out that every byte resets, a bound on the header section,
/// and the knowledge whether the body was read to its end.
class ConnectionStream : public httplib::Stream {
 public:
  /// Takes over the socket and closes it at the end.
  ConnectionStream(socket_t socket, const ServerOptions& options);
  ~ConnectionStream() override;
  ConnectionStream(const ConnectionStream&) = delete;
  ConnectionStream& operator=(const ConnectionStream&) = delete;

  /// Waits at most `limit` for the next request's first byte.
  bool waitForRequest(std::chrono::milliseconds limit);
  /// A request begins: its headers must be complete within the header deadline and size.
  void beginHeaders();
  /// The headers are complete; `length` bytes of body follow.
  void beginBody(std::uint64_t length);
  bool hasUnreadBody() const { return unread_body_ > 0; }

  bool is_readable() const override;
  bool is_writable() const override;
  ssize_t read(char* out, std::size_t size) override;
  ssize_t write(const char* bytes, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return socket_; }

 private:
  using Clock = std::chrono::steady_clock;
  enum class Part { kHeaders, kBody };

  bool waitFor(short events, Clock::time_point until) const;
  bool fill();
  void closeGently();

  socket_t socket_;
  const ServerOptions& options_;
  std::array<char, 16384> buffer_{};
  std::size_t begin_ = 0;  ///< unread bytes of buffer_ are [begin_, end_)
  std::size_t end_ = 0;
  Part part_ = Part::kHeaders;
  std::size_t header_bytes_ = 0;
  std::uint64_t unread_body_ = 0;
  Clock::time_point deadline_;
};

}  // namespace gaitmill::api

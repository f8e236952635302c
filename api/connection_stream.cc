#include "api/connection_stream.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace gaitmill::api {

namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr seconds kWriteLimit{10};         // for the client to take the next piece of a reply
constexpr milliseconds kLingerLimit{500};  // to drain what a refused client still sends
constexpr int kLingerReads = 256;

void readAddress(const sockaddr_storage& address, std::string& ip, int& port) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (address.ss_family == AF_INET) {
    sockaddr_in v4{};
    std::memcpy(&v4, &address, sizeof v4);
    inet_ntop(AF_INET, &v4.sin_addr, text.data(), text.size());
    port = ntohs(v4.sin_port);
  } else if (address.ss_family == AF_INET6) {
    sockaddr_in6 v6{};
    std::memcpy(&v6, &address, sizeof v6);
    inet_ntop(AF_INET6, &v6.sin6_addr, text.data(), text.size());
    port = ntohs(v6.sin6_port);
  }
  ip = text.data();
}

}  // namespace

ConnectionStream::ConnectionStream(socket_t socket, const ServerOptions& options)
    : socket_(socket), options_(options) {
  beginHeaders();
}

ConnectionStream::~ConnectionStream() {
  closeGently();
}

bool ConnectionStream::waitForRequest(milliseconds limit) {
  return begin_ < end_ || waitFor(POLLIN, Clock::now() + limit);
}

void ConnectionStream::beginHeaders() {
  part_ = Part::kHeaders;
  header_bytes_ = 0;
  unread_body_ = 0;
  deadline_ = Clock::now() + options_.header_deadline;
}

void ConnectionStream::beginBody(std::uint64_t length) {
  part_ = Part::kBody;
  unread_body_ = length;
  const std::uint64_t lowest_rate = std::max<std::uint64_t>(options_.lowest_rate, 1);
  const auto allowance = static_cast<seconds::rep>(
      std::min<std::uint64_t>(length, options_.max_upload_bytes) / lowest_rate);
  deadline_ = Clock::now() + options_.body_deadline + seconds(allowance);
}

bool ConnectionStream::is_readable() const {
  return begin_ < end_ || waitFor(POLLIN, deadline_);
}

bool ConnectionStream::is_writable() const {
  return waitFor(POLLOUT, Clock::now() + kWriteLimit);
}

bool ConnectionStream::waitFor(short events, Clock::time_point until) const {
  pollfd entry{socket_, events, 0};
  for (;;) {
    const auto left = std::chrono::ceil<milliseconds>(until - Clock::now()).count();
    const int ready = ::poll(&entry, 1, static_cast<int>(std::clamp<long>(left, 0, 600'000)));
    if (ready >= 0 || errno != EINTR) {
      return ready > 0 && (entry.revents & (events | POLLHUP)) != 0;
    }
  }
}

bool ConnectionStream::fill() {
  if (!waitFor(POLLIN, deadline_)) {
    return false;
  }
  const ssize_t got = ::recv(socket_, buffer_.data(), buffer_.size(), 0);
  begin_ = 0;
  end_ = got > 0 ? static_cast<std::size_t>(got) : 0;
  return got > 0;
}

ssize_t ConnectionStream::read(char* out, std::size_t size) {
  if (begin_ == end_ && !fill()) {
    return -1;
  }
  const std::size_t count = std::min(size, end_ - begin_);
  std::memcpy(out, buffer_.data() + begin_, count);
  begin_ += count;
  if (part_ == Part::kHeaders) {
    header_bytes_ += count;
    return header_bytes_ > options_.max_header_bytes ? -1 : static_cast<ssize_t>(count);
  }
  unread_body_ -= std::min<std::uint64_t>(unread_body_, count);
  return static_cast<ssize_t>(count);
}

ssize_t ConnectionStream::write(const char* bytes, std::size_t size) {
  if (!is_writable()) {
    return -1;
  }
  return ::send(socket_, bytes, size, MSG_NOSIGNAL | MSG_DONTWAIT);
}

void ConnectionStream::get_remote_ip_and_port(std::string& ip, int& port) const {
  sockaddr_storage address{};
  socklen_t length = sizeof address;
  // The sockets interface takes every family through this one pointer type.
  if (::getpeername(socket_, reinterpret_cast<sockaddr*>(&address), &length) == 0) {
    readAddress(address, ip, port);
  }
}

void ConnectionStream::get_local_ip_and_port(std::string& ip, int& port) const {
  sockaddr_storage address{};
  socklen_t length = sizeof address;
  if (::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &length) == 0) {
    readAddress(address, ip, port);
  }
}

// Closing while the client still sends would reset the connection and could destroy the reply that
// says why; so stop writing, drain for a moment, then close.
void ConnectionStream::closeGently() {
  ::shutdown(socket_, SHUT_WR);
  if (hasUnreadBody()) {
    const Clock::time_point until = Clock::now() + kLingerLimit;
    for (int reads = 0; reads < kLingerReads && waitFor(POLLIN, until); ++reads) {
      if (::recv(socket_, buffer_.data(), buffer_.size(), 0) <= 0) {
        break;
      }
    }
  }
  ::close(socket_);
}

}  // namespace gaitmill::api

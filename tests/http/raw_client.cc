#include "tests/http/raw_client.h"

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <utility>

namespace gaitmill {

namespace {

constexpr int kSilence = 10'000;  // [ms]; generous, for sanitizers

std::string toLower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  return text;
}

RawReply parseHead(const std::string& head) {
  RawReply reply;
  reply.status = head.size() > 12 ? std::stoi(head.substr(9, 3)) : 0;
  for (std::size_t at = head.find("\r\n"); at != std::string::npos;) {
    const std::size_t begin = at + 2;
    at = head.find("\r\n", begin);
    const std::string line = head.substr(begin, at - begin);
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) {
      reply.headers[toLower(line.substr(0, colon))] = line.substr(colon + 2);
    }
  }
  return reply;
}

}  // namespace

std::string RawReply::header(const std::string& lower_case_name) const {
  const auto found = headers.find(lower_case_name);
  return found == headers.end() ? "" : found->second;
}

RawClient::RawClient(int port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    close();
  }
}

RawClient::~RawClient() {
  close();
}

RawClient::RawClient(RawClient&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)), buffer_(std::move(other.buffer_)) {}

RawClient& RawClient::operator=(RawClient&& other) noexcept {
  std::swap(socket_, other.socket_);
  std::swap(buffer_, other.buffer_);
  return *this;
}

void RawClient::close() {
  if (socket_ >= 0) {
    ::close(std::exchange(socket_, -1));
  }
}

void RawClient::endSending() {
  ::shutdown(socket_, SHUT_WR);
}

bool RawClient::send(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent <= 0) {
      return false;
    }
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

bool RawClient::fill(int limit_ms) {
  pollfd entry{socket_, POLLIN, 0};
  if (::poll(&entry, 1, limit_ms) <= 0) {
    return false;
  }
  std::array<char, 65536> bytes{};
  const ssize_t got = ::recv(socket_, bytes.data(), bytes.size(), 0);
  if (got <= 0) {
    return false;
  }
  buffer_.append(bytes.data(), static_cast<std::size_t>(got));
  return true;
}

RawReply RawClient::readHead() {
  std::size_t end = 0;
  while ((end = buffer_.find("\r\n\r\n")) == std::string::npos) {
    if (!fill(kSilence)) {
      return {};
    }
  }
  const std::string head = buffer_.substr(0, end);
  buffer_.erase(0, end + 4);
  return parseHead(head);
}

RawReply RawClient::read() {
  RawReply reply = readHead();
  const std::string length = reply.header("content-length");
  const std::size_t size = length.empty() ? 0 : std::stoull(length);
  while (buffer_.size() < size && fill(kSilence)) {
  }
  reply.body = buffer_.substr(0, size);
  buffer_.erase(0, size);
  return reply;
}

std::string RawClient::readUntil(std::string_view text) {
  while (buffer_.find(text) == std::string::npos && fill(kSilence)) {
  }
  const std::size_t at = buffer_.find(text);
  const std::size_t size = at == std::string::npos ? buffer_.size() : at + text.size();
  const std::string bytes = buffer_.substr(0, size);
  buffer_.erase(0, size);
  return bytes;
}

std::string RawClient::readToEnd() {
  while (fill(kSilence)) {
  }
  return std::exchange(buffer_, "");
}

std::string RawClient::readSome(std::size_t size) {
  if (buffer_.empty()) {
    fill(kSilence);
  }
  const std::string bytes = buffer_.substr(0, size);
  buffer_.erase(0, bytes.size());
  return bytes;
}

bool RawClient::isClosedWithin(std::chrono::milliseconds limit) {
  pollfd entry{socket_, POLLIN, 0};
  char byte = 0;
  return ::poll(&entry, 1, static_cast<int>(limit.count())) > 0 &&
         ::recv(socket_, &byte, 1, 0) <= 0;
}

std::string makeGet(const std::string& path, const std::string& headers) {
  return "GET " + path + " HTTP/1.1\r\nHost: test\r\n" + headers + "\r\n";
}

std::string makeRequest(const std::string& method,
                        const std::string& path,
                        const std::string& content_type,
                        const std::string& body,
                        const std::string& headers) {
  return method + " " + path + " HTTP/1.1\r\nHost: test\r\nContent-Type: " + content_type +
         "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n" + headers + "\r\n" + body;
}

}  // namespace gaitmill

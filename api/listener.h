#pragma once

#include <cstddef>
#include <string>
#include <utility>

namespace gaitmill::api {

/// A file descriptor that is closed at the end.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  ~Descriptor() { reset(); }
  Descriptor(Descriptor&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int get() const { return descriptor_; }
  explicit operator bool() const { return descriptor_ >= 0; }
  void reset();

 private:
  int descriptor_ = -1;
};

/// A non-blocking listening socket on host and port. SO_REUSEPORT stays off: with it a second
/// service could share the port unnoticed.
/// @throws Error kServicePort if the address cannot be had
Descriptor openListener(const std::string& host, int port);
/// The port that a socket is bound to.
int findPort(const Descriptor& socket);

struct Accepted {
  Descriptor socket;    ///< non-blocking; empty if there is none
  std::string address;  ///< of the client, without port
  int fault = 0;        ///< errno if there is none
};
Accepted acceptClient(const Descriptor& listener);

bool isLoopback(const std::string& address);

/// Raises the soft limit of open files towards `wanted`, as far as the hard one allows. Never
/// lowers it. @returns the limit now
std::size_t raiseFileLimit(std::size_t wanted);

}  // namespace gaitmill::api

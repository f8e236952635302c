#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace gaitmill {

/// A file descriptor that closes itself.
class OwnedFd {
 public:
  explicit OwnedFd(int fd = -1) : fd_(fd) {}
  ~OwnedFd() { reset(); }
  OwnedFd(OwnedFd&& other) noexcept : fd_(other.release()) {}
  OwnedFd& operator=(OwnedFd&& other) noexcept;
  OwnedFd(const OwnedFd&) = delete;
  OwnedFd& operator=(const OwnedFd&) = delete;

  int get() const { return fd_; }
  int release();
  void reset();

 private:
  int fd_;
};

/// What a child process may use.
struct ChildLimits {
  int memory_mb = 2048;  ///< [MiB] of address space, 0 = no limit
  int nice = 10;         ///< added to the service's own niceness
};

/// The program that children run and its first arguments: {"/proc/self/exe", "solve"} is this very
/// program, even after its file has been replaced.
using ChildCommand = std::vector<std::string>;

/// A child process of this program with nothing but a channel to us: file 0 and 1 are /dev/null, 2
/// is a pipe to us, kChannelFd the channel; every other file is closed and the environment holds
/// only what the loader, the renderer and the sanitizers need. It dies when its channel closes, and
/// with the thread that started it. Started with posix_spawn, so that a service of many threads may
/// do it.
class Child {
 public:
  static constexpr int kChannelFd = 3;

  /// @throws Error kInternal if the machine has no process or no file left
  Child(const ChildCommand& command, const ChildLimits& limits);
  /// Kills it if it still runs.
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  pid_t pid() const { return pid_; }
  int channel() const { return channel_.get(); }  ///< a stream socket, non-blocking on our side
  int errors() const { return errors_.get(); }    ///< its standard error, non-blocking
  /// Kills it if it still runs, and waits until it is gone.
  /// @returns what ended it: "exit code 3", "signal SIGSEGV"
  std::string end();

 private:
  OwnedFd channel_;
  OwnedFd errors_;
  pid_t pid_ = -1;
};

/// For the first moment of a child: dies with its parent, gets no new privileges, no core file, no
/// file to write, the limits of its arguments, and ignores the signals by which the service is
/// stopped, because the service decides what becomes of its children. When the memory is used up
/// it sends `farewell` through the channel and ends.
/// @param parent  the process that started this one
void becomeChild(pid_t parent, const ChildLimits& limits, const std::string& farewell);

}  // namespace gaitmill

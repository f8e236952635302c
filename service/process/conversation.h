#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "service/process/child.h"
#include "service/process/frames.h"

namespace gaitmill {

/// Lets another thread interrupt a conversation at once.
class Interrupt {
 public:
  /// @throws Error kInternal if the machine has no file left
  Interrupt();
  void raise();
  void clear() const;
  int fd() const { return fd_.get(); }

 private:
  OwnedFd fd_;
};

/// What the service says to a child and hears from it. All functions are called from the thread
/// that converses.
struct Conversation {
  using Clock = std::chrono::steady_clock;

  /// The next message to send, nothing when all is said. Asked only when the last one has gone, so
  /// that a long upload never lies in memory as a whole.
  std::function<std::optional<Frame>()> speak;
  /// Takes one message; false = it was the last.
  std::function<bool(Frame&&)> hear;
  /// Takes one line of the child's standard error, without control characters beyond tabs.
  std::function<void(const std::string&)> overhear;
  /// Asked every `tick` and after an interrupt; false = stop now.
  std::function<bool()> go_on;
  /// When to give up on it unless something changes; asked after each message and tick.
  std::function<Clock::time_point()> deadline;
  std::chrono::milliseconds tick{2000};
  const Interrupt* interrupt = nullptr;
};

enum class ConversationEnd {
  kComplete,  ///< the last message has been heard
  kClosed,    ///< the child has ended, or said what no child of ours says
  kStopped,   ///< go_on said so
  kOverdue,   ///< the deadline has passed
};

/// Converses until one of the ends. Neither kills the child nor waits for it. What `hear`, `speak`
/// and `go_on` throw passes through.
ConversationEnd converse(const Child& child, const Conversation& conversation);

}  // namespace gaitmill

#include "service/process/conversation.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string_view>
#include <vector>

#include "core/base/error.h"

namespace gaitmill {

namespace {

using Clock = Conversation::Clock;

constexpr std::size_t kReadSize = 256U << 10U;  // [bytes]
constexpr int kReadsInARow = 16;
constexpr std::size_t kMaxLine = 1000;  // [bytes] of a line of standard error
constexpr int kMaxLines = 200;          // of standard error per child; the rest is dropped

// Lines of a child's standard error, bounded in length and number.
class LineCutter {
 public:
  explicit LineCutter(const std::function<void(const std::string&)>& take) : take_(take) {}
  ~LineCutter() = default;

  void append(std::string_view bytes) {
    for (const char letter : bytes) {
      if (letter == '\n') {
        flush();
      } else if (line_.size() < kMaxLine) {
        const auto code = static_cast<unsigned char>(letter);
        line_ += code < 0x20 || code == 0x7f ? ' ' : letter;
      }
    }
  }
  void flush() {
    if (!line_.empty() && lines_ < kMaxLines && take_) {
      take_(line_);
    }
    lines_ += line_.empty() ? 0 : 1;
    line_.clear();
  }

 private:
  const std::function<void(const std::string&)>& take_;
  std::string line_;
  int lines_ = 0;
};

class Talk {
 public:
  Talk(const Child& child, const Conversation& conversation)
      : child_(child), is_(conversation), errors_(conversation.overhear) {
    buffer_.resize(kReadSize);
    fillOutgoing();
  }

  ConversationEnd run() {
    next_tick_ = Clock::now() + is_.tick;
    std::optional<ConversationEnd> end;
    while (!end) {
      end = step();
    }
    readErrors();
    errors_.flush();
    return *end;
  }

 private:
  std::optional<ConversationEnd> step() {
    std::array<pollfd, 3> watched{};
    watched[0] = {
        child_.channel(), static_cast<short>(POLLIN | (outgoing_.empty() ? 0 : POLLOUT)), 0};
    watched[1] = {errors_open_ ? child_.errors() : -1, POLLIN, 0};
    watched[2] = {is_.interrupt == nullptr ? -1 : is_.interrupt->fd(), POLLIN, 0};
    ::poll(watched.data(), watched.size(), calcPatience());
    if (watched[1].revents != 0) {
      readErrors();
    }
    if ((watched[2].revents != 0 || Clock::now() >= next_tick_) && !tick()) {
      return ConversationEnd::kStopped;
    }
    if ((watched[0].revents & POLLOUT) != 0) {
      write();
    }
    if ((watched[0].revents & (POLLIN | POLLHUP | POLLERR)) != 0) {
      return read();
    }
    return Clock::now() >= is_.deadline() ? std::optional(ConversationEnd::kOverdue) : std::nullopt;
  }

  int calcPatience() const {
    const Clock::time_point until = std::min(next_tick_, is_.deadline());
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now());
    return static_cast<int>(std::clamp<std::int64_t>(left.count() + 1, 0, 60'000));
  }

  bool tick() {
    if (is_.interrupt != nullptr) {
      is_.interrupt->clear();
    }
    next_tick_ = Clock::now() + is_.tick;
    return is_.go_on();
  }

  // What was sent before the child died is still heard: its last words say why.
  std::optional<ConversationEnd> read() {
    const ssize_t size = ::recv(child_.channel(), buffer_.data(), buffer_.size(), 0);
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) {
      return std::nullopt;
    }
    if (size <= 0) {
      return ConversationEnd::kClosed;
    }
    incoming_.append({buffer_.data(), static_cast<std::size_t>(size)});
    while (std::optional<Frame> frame = incoming_.next()) {
      if (!is_.hear(std::move(*frame))) {
        return ConversationEnd::kComplete;
      }
    }
    return std::nullopt;
  }

  void write() {
    const ssize_t size = ::send(child_.channel(), outgoing_.data(), outgoing_.size(), MSG_NOSIGNAL);
    if (size > 0) {
      outgoing_.erase(0, static_cast<std::size_t>(size));
      fillOutgoing();
    } else if (errno != EAGAIN && errno != EINTR) {
      outgoing_.clear();  // it does not listen any more; reading tells why
    }
  }

  void fillOutgoing() {
    if (outgoing_.empty()) {
      if (const std::optional<Frame> frame = is_.speak()) {
        outgoing_ = encodeFrame(*frame);
      }
    }
  }

  // A child that floods its standard error must not keep us from hearing the rest.
  void readErrors() {
    for (int i = 0; i < kReadsInARow && errors_open_; ++i) {
      const ssize_t size = ::read(child_.errors(), buffer_.data(), buffer_.size());
      if (size > 0) {
        errors_.append({buffer_.data(), static_cast<std::size_t>(size)});
        continue;
      }
      errors_open_ = size < 0 && (errno == EAGAIN || errno == EINTR);
      return;
    }
  }

  const Child& child_;
  const Conversation& is_;
  FrameReader incoming_;
  std::string outgoing_;
  LineCutter errors_;
  bool errors_open_ = true;
  std::vector<char> buffer_;
  Clock::time_point next_tick_;
};

}  // namespace

Interrupt::Interrupt() : fd_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  check(fd_.get() >= 0, "no file descriptor is left for an interrupt");
}

void Interrupt::raise() {
  const std::uint64_t one = 1;
  const ssize_t ignored = ::write(fd_.get(), &one, sizeof one);
  static_cast<void>(ignored);
}

void Interrupt::clear() const {
  std::uint64_t count = 0;
  const ssize_t ignored = ::read(fd_.get(), &count, sizeof count);
  static_cast<void>(ignored);
}

ConversationEnd converse(const Child& child, const Conversation& conversation) {
  try {
    return Talk(child, conversation).run();
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kJobCrashed) {
      return ConversationEnd::kClosed;
    }
    throw;
  }
}

}  // namespace gaitmill

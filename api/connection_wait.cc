// What a connection waits for, and for how long.

#include <sys/epoll.h>

#include <algorithm>
#include <string_view>

#include "api/connection.h"
#include "core/base/error.h"

namespace gaitmill::api {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds kLingerLimit{2'000};
constexpr milliseconds kLingerAtStop{100};
// Between two questions to one long poll or event stream: a job may report hundreds of times per
// second, a person reads some.
constexpr milliseconds kAskGap{20};
// Longer with many who wait, so that all of them together ask at most 2 000 times per second
// however often their jobs report.
constexpr std::chrono::microseconds kAskGapPerWaiter{500};
constexpr std::string_view kPulse = ": still here\n\n";

}  // namespace

void Connection::enter(Phase phase) {
  context_.parked -= phase_ == Phase::kParked ? 1U : 0U;
  context_.event_streams -= phase_ == Phase::kStreaming ? 1U : 0U;
  phase_ = phase;
  since_ = Clock::now();
  context_.parked += phase_ == Phase::kParked ? 1U : 0U;
  context_.event_streams += phase_ == Phase::kStreaming ? 1U : 0U;
}

void Connection::beginWindow() {
  window_begin_ = Clock::now();
  window_bytes_ = 0;
}

// Whether the window that has passed saw bytes at the lowest rate; if so, another one begins.
bool Connection::keepsPace(milliseconds window) {
  const std::uint64_t least =
      context_.options.lowest_rate * static_cast<std::uint64_t>(window.count()) / 1000U;
  const bool is_our_turn = phase_ == Phase::kFetching || phase_ == Phase::kSpooling;
  const bool keeps = window_bytes_ >= least || is_our_turn;
  beginWindow();
  return keeps;
}

std::uint32_t Connection::interest() const {
  switch (phase_) {
    case Phase::kIdle:
    case Phase::kHead:
    case Phase::kBody:
    case Phase::kLingering:
      return EPOLLIN;
    case Phase::kWriting:
      return EPOLLOUT;
    case Phase::kParked:
      return EPOLLRDHUP;
    case Phase::kStreaming:
      return out_head_.empty() && out_body_.empty() ? EPOLLRDHUP : EPOLLRDHUP | EPOLLOUT;
    case Phase::kSpooling:
    case Phase::kHandling:
    case Phase::kFetching:
    case Phase::kFinished:
      break;
  }
  return 0;
}

const Topic& Connection::topic() const {
  static const Topic kNone;
  return phase_ == Phase::kParked || phase_ == Phase::kStreaming ? topic_ : kNone;
}

Clock::time_point Connection::askDue() const {
  const std::size_t waiters = context_.parked + context_.event_streams;
  const auto gap = kAskGap + kAskGapPerWaiter * waiters;
  const auto wait = is_changed_ ? std::min<Clock::duration>(gap, context_.options.ask_again)
                                : Clock::duration(context_.options.ask_again);
  return is_asking_ ? Clock::time_point::max() : asked_ + wait;
}

bool Connection::isAskDue(Clock::time_point now) const {
  return now >= askDue();
}

Clock::time_point Connection::due() const {
  const ServerOptions& options = context_.options;
  switch (phase_) {
    case Phase::kIdle:
      return since_ + options.keep_alive;
    case Phase::kHead:
      return since_ + options.header_deadline;
    case Phase::kBody:
    case Phase::kSpooling:
      return window_begin_ + options.body_deadline;
    case Phase::kWriting:
    case Phase::kFetching:
      return window_begin_ + options.reply_deadline;
    case Phase::kParked:
      return is_asking_ ? Clock::time_point::max() : std::min(askDue(), *park_until_);
    case Phase::kStreaming:
      return out_head_.empty() && out_body_.empty()
                 ? std::min(askDue(), pulse_ + options.stream_pulse)
                 : window_begin_ + options.reply_deadline;
    case Phase::kLingering:
      return since_ + (context_.stopping ? kLingerAtStop : kLingerLimit);
    case Phase::kHandling:
    case Phase::kFinished:
      break;
  }
  return Clock::time_point::max();
}

void Connection::onTimer(Clock::time_point now) {
  if (now < due()) {
    return;
  }
  const ServerOptions& options = context_.options;
  switch (phase_) {
    case Phase::kHead:
      breakOff(Error(ErrorCode::kRequestTimeout,
                     "the headers were not complete in time",
                     {"", 0, 0, "headers"}));
      break;
    case Phase::kBody:
    case Phase::kSpooling:
      if (!keepsPace(options.body_deadline)) {
        breakOff(
            Error(ErrorCode::kRequestTimeout, "the body comes too slowly", {"", 0, 0, "body"}));
      }
      break;
    case Phase::kWriting:
    case Phase::kFetching:
      if (!keepsPace(options.reply_deadline)) {
        close();
      }
      break;
    case Phase::kParked:
      onParkedTimer(now);
      break;
    case Phase::kStreaming:
      onStreamTimer(now);
      break;
    default:
      close();
      break;
  }
}

void Connection::onParkedTimer(Clock::time_point now) {
  if (is_asking_) {
    return;
  }
  const bool is_over = context_.stopping || now >= *park_until_;
  if (is_over || isAskDue(now)) {
    exchange_->request.wait_is_over = is_over;
    ask(HandlerPool::Lane::kContinue);
  }
}

void Connection::onStreamTimer(Clock::time_point now) {
  if (!out_head_.empty() || !out_body_.empty()) {
    // The client takes nothing; flush() begins a new window when it does.
    if (now >= window_begin_ + context_.options.reply_deadline) {
      close();
    }
    return;
  }
  if (isAskDue(now)) {
    askEvents();
  }
  if (now >= pulse_ + context_.options.stream_pulse) {
    pulse_ = now;
    out_body_ = kPulse;
    flush();
  }
}

}  // namespace gaitmill::api

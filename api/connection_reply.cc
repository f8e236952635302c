// What a connection does to answer its request.

#include <sys/socket.h>
#include <sys/uio.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <ctime>
#include <string_view>
#include <utility>

#include "api/connection.h"
#include "core/base/error.h"

namespace gaitmill::api {

bool Connection::ask(HandlerPool::Lane lane) {
  is_asking_ = true;
  is_changed_ = false;
  asked_ = Clock::now();
  Answer answer;
  answer.connection = id_;
  answer.step = ++step_;
  return context_.pool.submit(
      lane,
      [answer, exchange = exchange_, &log = context_.log, &mailbox = context_.mailbox]() mutable {
        answer.asked_at = mailbox.sequence();
        answer.response = answerExchange(*exchange, log);
        exchange = nullptr;
        mailbox.put(std::move(answer));
      });
}

void Connection::takeResponse(Answer answer) {
  if (answer.response.park) {
    park(*answer.response.park, answer.asked_at);
  } else if (answer.response.events) {
    beginStream(std::move(answer.response), answer.asked_at);
  } else {
    beginReply(std::move(answer.response));
  }
}

void Connection::park(const Park& wish, std::uint64_t asked_at) {
  if (exchange_->request.wait_is_over) {
    refuse(Error(ErrorCode::kInternal, "a route parks a request that has waited long enough"));
    return;
  }
  topic_ = wish.topic;
  if (!park_until_) {
    park_until_ = asked_ + std::min(wish.limit, context_.options.max_park);
  }
  is_changed_ = is_changed_ || context_.notices.isChangedSince(topic_, asked_at);
  enter(Phase::kParked);
  onParkedTimer(Clock::now());
}

void Connection::refuse(const Error& error) {
  ++step_;
  HttpReply reply = context_.gate.refuse(error, head_, record_.id);
  context_.log(LogLevel::kDebug, record_.id + " " + client_ + " refused: " + error.what());
  beginReply(prepareResponse(std::move(reply), findReplyConditions(head_, record_.id)));
}

// Refuses what cannot be read to its end, so that nothing behind it can be a request.
void Connection::breakOff(const Error& error) {
  close_after_ = true;
  discardBody();
  releaseMemory(input_);
  refuse(error);
}

void Connection::beginReply(Response response) {
  close_after_ = close_after_ || context_.stopping;
  record_.status = response.status;
  composeHead(response);
  out_body_ = std::move(response.body);
  source_ = std::move(response.source);
  source_offset_ = response.offset;
  source_left_ = response.remaining;
  enter(Phase::kWriting);
  beginWindow();
  goOnWriting();
}

void Connection::composeHead(const Response& response) {
  out_sent_ = 0;
  out_head_ = response.head + "Date: " + formatHttpDate(std::time(nullptr)) + "\r\n";
  if (close_after_) {
    out_head_ += "Connection: close\r\n";
  } else if (head_.has("connection")) {
    out_head_ += "Connection: keep-alive\r\n";
  }
  out_head_ += "\r\n";
}

// Sends what is ready. @returns false if something is left or the client is gone
bool Connection::flush() {
  while (out_sent_ < out_head_.size() + out_body_.size()) {
    const std::size_t of_head = std::min(out_sent_, out_head_.size());
    const std::size_t of_body = out_sent_ - of_head;
    std::array<iovec, 2> pieces = {iovec{out_head_.data() + of_head, out_head_.size() - of_head},
                                   iovec{out_body_.data() + of_body, out_body_.size() - of_body}};
    msghdr message{};
    message.msg_iov = pieces.data();
    message.msg_iovlen = pieces.size();
    const ssize_t sent = ::sendmsg(socket(), &message, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && errno == EINTR) {
      continue;
    }
    if (sent < 0) {
      if (errno != EAGAIN) {
        close();
      }
      return false;
    }
    out_sent_ += static_cast<std::size_t>(sent);
    window_bytes_ += static_cast<std::uint64_t>(sent);
    record_.reply_bytes += static_cast<std::uint64_t>(sent);
  }
  out_sent_ = 0;
  releaseMemory(out_head_);
  releaseMemory(out_body_);
  return true;
}

void Connection::goOnWriting() {
  if (!flush()) {
    return;
  }
  if (source_left_ > 0) {
    fetchPiece();
  } else {
    endReply();
  }
}

void Connection::fetchPiece() {
  enter(Phase::kFetching);
  const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(source_left_, kPieceBytes));
  Answer answer;
  answer.connection = id_;
  answer.step = ++step_;
  context_.pool.submit(HandlerPool::Lane::kContinue,
                       [answer,
                        size,
                        offset = source_offset_,
                        source = source_,
                        id = record_.id,
                        &log = context_.log,
                        &mailbox = context_.mailbox]() mutable {
                         try {
                           answer.piece = source->read(offset, size);
                         } catch (const std::exception& error) {
                           log(LogLevel::kError, id + " breaks off: " + error.what());
                         }
                         answer.failed = answer.piece.size() != size;
                         source = nullptr;
                         mailbox.put(std::move(answer));
                       });
}

// The head is out, so that a failed read can only be told by ending before Content-Length.
void Connection::takePiece(Answer answer) {
  if (answer.failed) {
    close();
    return;
  }
  out_body_ = std::move(answer.piece);
  source_offset_ += out_body_.size();
  source_left_ -= out_body_.size();
  enter(Phase::kWriting);
  goOnWriting();
}

void Connection::beginStream(Response response, std::uint64_t asked_at) {
  if (context_.event_streams >= context_.options.max_event_streams) {
    refuse(Error(ErrorCode::kRequestBusy,
                 "too many event streams are open; ask for the job instead",
                 {"", 0, 0, "service"}));
    return;
  }
  close_after_ = true;  // the stream ends with the connection
  record_.status = response.status;
  composeHead(response);
  out_body_ = std::move(response.body);
  stream_ended_ = response.events_ended;
  topic_ = response.events->topic;
  exchange_->events = std::move(response.events);
  // One call returns a bounded number of events, so that more may be there.
  is_changed_ =
      is_changed_ || !out_body_.empty() || context_.notices.isChangedSince(topic_, asked_at);
  enter(Phase::kStreaming);
  pulse_ = Clock::now();
  beginWindow();
  goOnStreaming();
}

void Connection::goOnStreaming() {
  if (!flush()) {
    return;
  }
  beginWindow();
  if (stream_ended_ || context_.stopping) {
    endReply();
  } else {
    onStreamTimer(Clock::now());
  }
}

void Connection::askEvents() {
  is_asking_ = true;
  is_changed_ = false;
  asked_ = Clock::now();
  Answer answer;
  answer.connection = id_;
  answer.step = ++step_;
  context_.pool.submit(
      HandlerPool::Lane::kContinue,
      [answer, exchange = exchange_, &log = context_.log, &mailbox = context_.mailbox]() mutable {
        try {
          answer.piece = exchange->events->next(answer.events_ended);
        } catch (const std::exception& error) {
          log(LogLevel::kError, exchange->request.id + " ends its events: " + error.what());
          answer.events_ended = true;
        }
        exchange = nullptr;
        mailbox.put(std::move(answer));
      });
}

void Connection::takeEvents(Answer answer) {
  stream_ended_ = answer.events_ended;
  if (!answer.piece.empty()) {
    out_body_ += answer.piece;
    is_changed_ = true;
    pulse_ = Clock::now();
  }
  goOnStreaming();
}

void Connection::endReply() {
  record();
  exchange_ = nullptr;
  source_ = nullptr;
  park_until_ = std::nullopt;
  topic_.clear();
  head_ = {};
  admission_ = {};
  if (!close_after_) {
    enter(Phase::kIdle);
    return;
  }
  releaseMemory(input_);
  ::shutdown(socket(), SHUT_WR);
  enter(Phase::kLingering);
}

void Connection::record() {
  if (!context_.options.on_request) {
    return;
  }
  record_.seconds = std::chrono::duration<double>(Clock::now() - started_).count();
  try {
    context_.options.on_request(record_);
  } catch (const std::exception& error) {
    context_.log(LogLevel::kError, record_.id + " cannot be recorded: " + error.what());
  }
}

void Connection::close() {
  switch (phase_) {
    case Phase::kIdle:
    case Phase::kHead:
    case Phase::kLingering:
    case Phase::kFinished:
      break;
    default:
      record();
      break;
  }
  discardBody();
  enter(Phase::kFinished);
}

// The end of a file waits for the disk's journal, which this thread must not.
void Connection::discardBody() {
  if (body_ && body_->isOnDisk()) {
    context_.pool.submit(HandlerPool::Lane::kContinue,
                         [body = std::exchange(body_, nullptr)]() mutable { body = nullptr; });
  }
  body_ = nullptr;
}

}  // namespace gaitmill::api

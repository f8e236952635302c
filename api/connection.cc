#include "api/connection.h"

#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "core/base/error.h"

namespace gaitmill::api {

namespace {

constexpr std::size_t kLeastSpooled = 32U << 10U;  // [bytes] of a body written to disk at once
constexpr int kRequestsPerTurn = 16;               // of one connection before others have theirs
constexpr std::size_t kMaxClientId = 64;
constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";

// The client's own id if it can stand in a header and in a log line.
bool isHarmlessId(const std::string& id) {
  return !id.empty() && id.size() <= kMaxClientId &&
         std::all_of(id.begin(), id.end(), [](unsigned char letter) {
           return std::isalnum(letter) != 0 || letter == '-' || letter == '_' || letter == '.';
         });
}

std::string makeRequestId(std::mt19937_64& random) {
  static constexpr std::string_view kDigits = "0123456789abcdefghjkmnpqrstvwxyz";
  std::string id = "req_";
  std::uint64_t bits = random();
  for (int i = 0; i < 12; ++i, bits >>= 5U) {
    id += kDigits[bits & 31U];
  }
  return id;
}

HeadLimits makeHeadLimits(const ServerOptions& options) {
  return {options.max_target_bytes, options.max_header_bytes, options.max_headers};
}

}  // namespace

Connection::Connection(std::uint64_t id,
                       Descriptor socket,
                       std::string client,
                       TransportContext& context)
    : id_(id),
      socket_(std::move(socket)),
      client_(std::move(client)),
      context_(context),
      since_(Clock::now()) {}

Connection::~Connection() {
  enter(Phase::kFinished);
}

// --- events ---

void Connection::onReadable() {
  auto& buffer = context_.read_buffer;
  const ssize_t got = ::recv(socket(), buffer.data(), buffer.size(), MSG_DONTWAIT);
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) {
    return;
  }
  if (got <= 0) {
    close();
    return;
  }
  if (phase_ != Phase::kLingering) {
    input_.append(buffer.data(), static_cast<std::size_t>(got));
    advance();
  }
}

void Connection::onWritable() {
  if (phase_ == Phase::kWriting) {
    goOnWriting();
  } else if (phase_ == Phase::kStreaming) {
    goOnStreaming();
  }
  advance();
}

void Connection::onHangUp() {
  close();
}

void Connection::onTurn() {
  advance();
}

void Connection::onNotice() {
  is_changed_ = true;
  onTimer(Clock::now());
}

void Connection::onAnswer(Answer answer) {
  if (answer.step != step_) {
    return;
  }
  is_asking_ = false;
  switch (phase_) {
    case Phase::kHandling:
    case Phase::kParked:
      takeResponse(std::move(answer));
      break;
    case Phase::kFetching:
      takePiece(std::move(answer));
      break;
    case Phase::kSpooling:
      takeSpooled(answer);
      break;
    case Phase::kStreaming:
      takeEvents(std::move(answer));
      break;
    default:
      break;
  }
  advance();
}

void Connection::turnAway(const Error& error) {
  started_ = Clock::now();
  record_.id = makeRequestId(context_.request_ids);
  record_.client = client_;
  breakOff(error);
}

void Connection::onStop() {
  switch (phase_) {
    case Phase::kIdle:
    case Phase::kHead:
      close();
      break;
    case Phase::kBody:
    case Phase::kSpooling:
      breakOff(Error(ErrorCode::kServiceUnready, "the service is stopping", {"", 0, 0, "service"}));
      break;
    case Phase::kParked:
      onParkedTimer(Clock::now());
      break;
    case Phase::kStreaming:
      goOnStreaming();
      break;
    default:
      close_after_ = true;
      break;
  }
}

// --- reading ---

// Takes from input_ what is complete. After some requests it is others' turn.
void Connection::advance() {
  wants_turn_ = false;
  for (int requests = 0; requests < kRequestsPerTurn;) {
    if (phase_ == Phase::kIdle || phase_ == Phase::kHead) {
      if (!takeHead()) {
        return;
      }
      ++requests;
    } else if (phase_ != Phase::kBody || !takeBody()) {
      return;
    }
  }
  wants_turn_ = phase_ == Phase::kIdle && !input_.empty();
}

// @returns false if there is no complete head
bool Connection::takeHead() {
  // RFC 9112, 2.2: empty lines before a request are skipped.
  while (phase_ == Phase::kIdle && input_.compare(0, 2, "\r\n") == 0) {
    input_.erase(0, 2);
  }
  if (input_.empty() || input_ == "\r") {
    return false;
  }
  if (phase_ == Phase::kIdle) {
    started_ = Clock::now();
    record_ = {};
    record_.id = makeRequestId(context_.request_ids);
    record_.client = client_;
    enter(Phase::kHead);
  }
  try {
    const HeadLimits limits = makeHeadLimits(context_.options);
    const std::size_t end = findHeadEnd(input_, scanned_);
    if (end == std::string::npos) {
      checkPartialHead(input_, limits);
      scanned_ = input_.size();
      return false;
    }
    head_ = parseRequestHead(std::string_view(input_).substr(0, end), limits);
    input_.erase(0, end);
    scanned_ = 0;
    beginRequest();
  } catch (const Error& error) {
    breakOff(error);
  }
  return true;
}

void Connection::beginRequest() {
  const std::string& client_id = head_.header("x-request-id");
  if (isHarmlessId(client_id)) {
    record_.id = client_id;
  }
  record_.method = head_.method;
  record_.path = head_.path;
  close_after_ = !head_.keep_alive || context_.stopping;
  const bool has_body = head_.content_length.value_or(0) > 0 || head_.has("transfer-encoding");
  try {
    if (head_.method == "OPTIONS") {
      close_after_ = close_after_ || has_body;
      beginReply(
          prepareResponse(context_.gate.describe(head_), findReplyConditions(head_, record_.id)));
      return;
    }
    admission_ = context_.gate.admit(head_);
    startExchange();
    if (admission_.body_bytes > 0) {
      beginBody();
    } else {
      dispatch();
    }
  } catch (const Error& error) {
    close_after_ = close_after_ || has_body;
    refuse(error);
  }
}

void Connection::startExchange() {
  record_.pattern = admission_.match.route->pattern;
  record_.tenant = admission_.identity.tenant;
  record_.key_id = admission_.identity.key_id;
  record_.request_bytes = admission_.body_bytes;
  exchange_ = std::make_shared<Exchange>();
  exchange_->route = admission_.match.route;
  exchange_->conditions = findReplyConditions(head_, record_.id);
  exchange_->boundary = admission_.boundary;
  exchange_->multipart.parts = context_.options.max_parts;
  HttpRequest& request = exchange_->request;
  request.id = record_.id;
  request.method = admission_.match.route->method;
  request.path = head_.path;
  request.captures = std::move(admission_.match.captures);
  request.query = std::move(head_.query);
  request.headers = head_.headers;
  request.identity = admission_.identity;
  request.body = makeByteSource("");
}

void Connection::beginBody() {
  body_ = context_.bodies.open(admission_.body_bytes);
  body_left_ = admission_.body_bytes;
  enter(Phase::kBody);
  beginWindow();
  if (head_.has("expect") && input_.empty()) {
    const ssize_t sent = ::send(socket(), kContinue.data(), kContinue.size(), MSG_NOSIGNAL);
    if (sent != static_cast<ssize_t>(kContinue.size())) {
      close();
    }
  }
}

// @returns false while bytes are missing
bool Connection::takeBody() {
  const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(body_left_, input_.size()));
  if (body_->isOnDisk()) {
    const bool is_enough = size == body_left_ || size >= kLeastSpooled;
    if (is_enough) {
      spoolPiece(size);
    }
    return is_enough;
  }
  body_->append(std::string_view(input_).substr(0, size));
  input_.erase(0, size);
  body_left_ -= size;
  window_bytes_ += size;
  if (body_left_ > 0) {
    releaseMemory(input_);
    return false;
  }
  dispatch();
  return true;
}

// Writing may wait for the disk, which this thread must not.
void Connection::spoolPiece(std::size_t size) {
  std::string bytes = input_.substr(0, size);
  input_.erase(0, size);
  body_left_ -= size;
  window_bytes_ += size;
  enter(Phase::kSpooling);
  Answer answer;
  answer.connection = id_;
  answer.step = ++step_;
  context_.pool.submit(
      HandlerPool::Lane::kContinue,
      [answer, bytes = std::move(bytes), body = body_, &mailbox = context_.mailbox]() mutable {
        try {
          body->append(bytes);
        } catch (const Error& error) {
          answer.failed = true;
          answer.fault = error;
        }
        body = nullptr;
        mailbox.put(std::move(answer));
      });
}

void Connection::takeSpooled(const Answer& answer) {
  if (answer.failed) {
    context_.log(LogLevel::kError, record_.id + " " + record_.path + ": " + answer.fault->what());
    breakOff(*answer.fault);
  } else if (body_left_ > 0) {
    enter(Phase::kBody);
  } else {
    dispatch();
  }
}

void Connection::dispatch() {
  if (body_) {
    exchange_->request.body = std::exchange(body_, nullptr)->finish();
  }
  enter(Phase::kHandling);
  const bool is_heavy =
      exchange_->route->is_slow || admission_.body_bytes > context_.options.spool_above;
  if (!ask(is_heavy ? HandlerPool::Lane::kHeavy : HandlerPool::Lane::kQuick)) {
    refuse(Error(ErrorCode::kRequestBusy,
                 "more requests are waiting than the service can answer soon",
                 {"", 0, 0, "service"}));
  }
}

}  // namespace gaitmill::api

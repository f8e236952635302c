#include "api/connection.h"

#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <utility>

#include "core/base/error.h"

namespace gaitmill::api {

namespace {

using std::chrono::milliseconds;

constexpr std::size_t kLeastSpooled = 32U << 10U;  // [bytes] of a body written to disk at once
constexpr int kRequestsPerTurn = 16;               // of one connection before others have theirs
constexpr std::size_t kMaxClientId = 64;
constexpr milliseconds kLingerLimit{2'000};
constexpr milliseconds kLingerAtStop{100};
// Between two questions to one long poll or event stream: a job may report hundreds of times per
// second, a person reads some.
constexpr milliseconds kAskGap{20};
constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
constexpr std::string_view kPulse = ": still here\n\n";

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

void releaseMemory(std::string& text) {
  std::string().swap(text);
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
  const bool is_heavy = admission_.body_bytes > context_.options.spool_above;
  if (!ask(is_heavy ? HandlerPool::Lane::kHeavy : HandlerPool::Lane::kQuick)) {
    refuse(Error(ErrorCode::kRequestBusy,
                 "more requests are waiting than the service can answer soon",
                 {"", 0, 0, "service"}));
  }
}

// --- answering ---

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
  body_ = nullptr;
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
  enter(Phase::kFinished);
}

// --- waiting ---

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
  return is_asking_ ? Clock::time_point::max()
                    : asked_ + (is_changed_ ? kAskGap : context_.options.ask_again);
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

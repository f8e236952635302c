#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <string_view>

#include "api/body_store.h"
#include "api/exchange.h"
#include "api/gate.h"
#include "api/handler_pool.h"
#include "api/listener.h"
#include "api/mailbox.h"
#include "api/response.h"
#include "api/server.h"
#include "core/base/error.h"

namespace gaitmill::api {

using Clock = std::chrono::steady_clock;

/// What all connections share. Used on the reactor's thread, apart from pool, mailbox and log.
struct TransportContext {
  const ServerOptions& options;
  const Gate& gate;
  const ServerLog& log;
  BodyStore& bodies;
  HandlerPool& pool;
  Mailbox& mailbox;
  NoticeLog& notices;
  std::size_t event_streams = 0;
  std::size_t parked = 0;
  bool stopping = false;
  std::mt19937_64 request_ids{std::random_device{}()};
  std::array<char, 65536> read_buffer{};
};

/// Empties a string and gives its memory back: thousands of connections keep theirs otherwise.
inline void releaseMemory(std::string& text) {
  std::string().swap(text);
}

/// One client's socket, non-blocking, through its requests: reading head and body, waiting for a
/// handler thread, writing the reply, and the long waits of long polls and event streams. Never
/// blocks and never throws; every call does what can be done now. Afterwards the owner asks
/// finished(), interest(), due() and topic() for what to wait for next.
class Connection {
 public:
  Connection(std::uint64_t id, Descriptor socket, std::string client, TransportContext& context);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void onReadable();
  void onWritable();
  /// The client is gone.
  void onHangUp();
  void onTimer(Clock::time_point now);
  void onAnswer(Answer answer);
  /// The topic has changed.
  void onNotice();
  /// Goes on with requests that were read already.
  void onTurn();
  /// Refuses a client before it has said anything.
  void turnAway(const Error& error);
  /// Answers what is under way and takes no more requests.
  void onStop();

  bool finished() const { return phase_ == Phase::kFinished; }
  bool wantsTurn() const { return wants_turn_; }
  std::uint32_t interest() const;  ///< EPOLLIN, EPOLLOUT, EPOLLRDHUP
  /// Whether reading may stay armed though nothing is to be read now, which saves a system call.
  bool toleratesInput() const { return phase_ == Phase::kHandling || phase_ == Phase::kSpooling; }
  Clock::time_point due() const;
  const Topic& topic() const;  ///< of what it waits for, empty if nothing
  bool isIdle() const { return phase_ == Phase::kIdle; }
  Clock::time_point idle_since() const { return since_; }
  int socket() const { return socket_.get(); }
  const std::string& client() const { return client_; }

 private:
  enum class Phase {
    kIdle,       ///< between requests
    kHead,       ///< reading a head
    kBody,       ///< reading a body
    kSpooling,   ///< a handler thread writes a piece of the body to the disk
    kHandling,   ///< a handler thread has the request
    kParked,     ///< a long poll waits for its topic
    kWriting,    ///< a reply is being sent
    kFetching,   ///< a handler thread reads the next piece of a reply
    kStreaming,  ///< an event stream
    kLingering,  ///< the reply is sent; drains what the client still sends, so that closing does
                 ///< not reset the connection and destroy the reply
    kFinished,
  };

  // --- reading ---
  void advance();
  bool takeHead();
  void beginRequest();
  void startExchange();
  void beginBody();
  bool takeBody();
  void spoolPiece(std::size_t size);
  void takeSpooled(const Answer& answer);
  void dispatch();

  // --- answering ---
  bool ask(HandlerPool::Lane lane);
  void takeResponse(Answer answer);
  void park(const Park& wish, std::uint64_t asked_at);
  void refuse(const Error& error);
  void breakOff(const Error& error);
  void beginReply(Response response);
  void composeHead(const Response& response);
  bool flush();
  void goOnWriting();
  void fetchPiece();
  void takePiece(Answer answer);
  void beginStream(Response response, std::uint64_t asked_at);
  void goOnStreaming();
  void askEvents();
  void takeEvents(Answer answer);
  void endReply();
  void discardBody();
  void record();
  void close();

  // --- waiting ---
  void enter(Phase phase);
  void beginWindow();
  bool keepsPace(std::chrono::milliseconds window);
  void onParkedTimer(Clock::time_point now);
  void onStreamTimer(Clock::time_point now);
  bool isAskDue(Clock::time_point now) const;
  Clock::time_point askDue() const;

  const std::uint64_t id_;
  const Descriptor socket_;
  const std::string client_;
  TransportContext& context_;
  Phase phase_ = Phase::kIdle;
  Clock::time_point since_;  ///< the phase's beginning
  bool wants_turn_ = false;

  // the request
  std::string input_;
  std::size_t scanned_ = 0;  ///< bytes of input_ without an end of head
  RequestHead head_;
  Admission admission_;
  std::shared_ptr<BodyBuffer> body_;
  std::uint64_t body_left_ = 0;
  std::shared_ptr<Exchange> exchange_;
  std::uint64_t step_ = 0;  ///< of handler tasks; the last one's answer is awaited
  bool close_after_ = false;
  Clock::time_point started_;  ///< the request's first byte
  RequestRecord record_;

  // the reply
  std::string out_head_;
  std::string out_body_;
  std::size_t out_sent_ = 0;  ///< of head and body together
  std::shared_ptr<const ByteSource> source_;
  std::uint64_t source_offset_ = 0;
  std::uint64_t source_left_ = 0;
  bool stream_ended_ = false;

  // pace of the bytes of a body or a reply
  Clock::time_point window_begin_;
  std::uint64_t window_bytes_ = 0;

  // a long poll or an event stream
  Topic topic_;
  bool is_changed_ = false;  ///< since it was asked last
  bool is_asking_ = false;
  Clock::time_point asked_;
  std::optional<Clock::time_point> park_until_;
  Clock::time_point pulse_;  ///< the last byte on an event stream
};

}  // namespace gaitmill::api

#include "api/reactor.h"

#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include "core/base/error.h"

namespace gaitmill::api {

namespace {

using std::chrono::milliseconds;

constexpr std::uint64_t kListenerId = 0;
constexpr std::uint64_t kWakeId = 1;
constexpr std::uint64_t kFirstConnectionId = 2;
constexpr int kAcceptsAtOnce = 64;
constexpr std::size_t kTurnedAwayAtOnce = 64;  // connections beyond the limit, to be told so
constexpr std::size_t kOwnFiles = 256;         // descriptors for database, logs and children
constexpr milliseconds kAcceptPause{100};      // after descriptors have run out
constexpr milliseconds kIdleBeforeEviction{1'000};

}  // namespace

Reactor::Reactor(std::vector<Route> routes, ServerOptions options, ServerLog log)
    : options_(std::move(options)),
      log_(std::move(log)),
      router_(std::move(routes)),
      gate_(router_, options_),
      bodies_(options_),
      epoll_(::epoll_create1(EPOLL_CLOEXEC)),
      wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      mailbox_([this] { wake(); }),
      next_id_(kFirstConnectionId) {
  check(static_cast<bool>(epoll_) && static_cast<bool>(wake_), "no descriptors for the reactor");
}

Reactor::~Reactor() {
  pool_ = nullptr;  // its tasks write to the mailbox
  entries_.clear();
}

int Reactor::bind() {
  // A connection may have a spool file besides its socket.
  const std::size_t wanted = 2 * options_.max_connections + kTurnedAwayAtOnce + kOwnFiles;
  const std::size_t files = raiseFileLimit(wanted);
  if (files < wanted) {
    options_.max_connections =
        std::max<std::size_t>(files > 2 * kOwnFiles ? (files - kOwnFiles) / 2 : kOwnFiles / 2, 1);
    log_(LogLevel::kError,
         "the limit of open files allows only " + std::to_string(options_.max_connections) +
             " connections");
  }
  listener_ = openListener(options_.host, options_.port);
  return findPort(listener_);
}

void Reactor::run() {
  if (stop_asked_) {
    return;
  }
  pool_ = std::make_unique<HandlerPool>(options_.threads, options_.max_queued);
  context_ = std::make_unique<TransportContext>(
      TransportContext{options_, gate_, log_, bodies_, *pool_, mailbox_, notices_});
  serve();
  pool_ = nullptr;
  entries_.clear();
  timers_.clear();
  watchers_.clear();
  publishLoad();
}

void Reactor::stop() {
  stop_asked_ = true;
  wake();
}

void Reactor::notify(const Topic& topic) {
  mailbox_.put(topic);
}

ServerLoad Reactor::load() const {
  return {load_connections_, load_streams_, load_parked_, load_queued_};
}

void Reactor::wake() const {
  const std::uint64_t one = 1;
  // It fails only if the counter is full, and then the reactor is awake.
  if (::write(wake_.get(), &one, sizeof one) < 0 && errno != EAGAIN) {
    log_(LogLevel::kError, "the reactor cannot be woken");
  }
}

void Reactor::serve() {
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.u64 = kWakeId;
  ::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, wake_.get(), &event);
  setAccepting(true);
  while (!context_->stopping || (!entries_.empty() && Clock::now() < stop_at_)) {
    waitForEvents();
    takeMail();
    runTimers();
    runTurns();
    publishLoad();
    if (stop_asked_ && !context_->stopping) {
      beginStop();
    }
  }
}

void Reactor::waitForEvents() {
  std::array<epoll_event, 256> events{};
  const int count =
      ::epoll_wait(epoll_.get(), events.data(), static_cast<int>(events.size()), findTimeout());
  for (int i = 0; i < count; ++i) {
    const epoll_event& event = events[static_cast<std::size_t>(i)];
    if (event.data.u64 == kListenerId) {
      acceptClients();
    } else if (event.data.u64 == kWakeId) {
      std::uint64_t wakes = 0;
      if (::read(wake_.get(), &wakes, sizeof wakes) < 0 && errno != EAGAIN) {
        log_(LogLevel::kError, "the reactor's wake-up cannot be read");
      }
    } else {
      onEvent(event.data.u64, event.events);
    }
  }
}

// [ms] until the next deadline; -1 = none.
int Reactor::findTimeout() const {
  if (!turns_.empty()) {
    return 0;
  }
  Clock::time_point next = std::min(accept_again_, stop_at_);
  if (!timers_.empty()) {
    next = std::min(next, timers_.begin()->first);
  }
  if (next == Clock::time_point::max()) {
    return -1;
  }
  const auto left = std::chrono::ceil<milliseconds>(next - Clock::now()).count();
  return static_cast<int>(std::clamp<milliseconds::rep>(left, 0, 60'000));
}

void Reactor::onEvent(std::uint64_t id, std::uint32_t events) {
  with(id, [&](Entry& entry) {
    Connection& connection = *entry.connection;
    const std::uint32_t wanted = connection.interest();
    const bool is_gone =
        (events & (EPOLLERR | EPOLLHUP)) != 0 || (events & wanted & EPOLLRDHUP) != 0;
    if (is_gone) {
      connection.onHangUp();
    } else if ((events & wanted & EPOLLIN) != 0) {
      connection.onReadable();
    } else if ((events & wanted & EPOLLOUT) != 0) {
      connection.onWritable();
    } else {
      arm(id, entry, wanted);  // input that was tolerated has come and must wait
    }
  });
}

void Reactor::takeMail() {
  std::vector<Notice> notices;
  std::vector<Answer> answers;
  mailbox_.take(notices, answers);
  // Notices first: an answer that parks must find those that came while it was made.
  for (const Notice& notice : notices) {
    onNotice(notice);
  }
  for (Answer& answer : answers) {
    with(answer.connection, [&](Entry& entry) { entry.connection->onAnswer(std::move(answer)); });
  }
}

void Reactor::onNotice(const Notice& notice) {
  notices_.note(notice);
  const auto found = watchers_.find(notice.topic);
  if (found == watchers_.end()) {
    return;
  }
  const std::vector<std::uint64_t> ids(found->second.begin(), found->second.end());
  for (const std::uint64_t id : ids) {
    with(id, [](Entry& entry) { entry.connection->onNotice(); });
  }
}

void Reactor::runTimers() {
  const Clock::time_point now = Clock::now();
  while (!timers_.empty() && timers_.begin()->first <= now) {
    const std::uint64_t id = timers_.begin()->second;
    timers_.erase(timers_.begin());
    with(id, [now](Entry& entry) {
      entry.timer = Clock::time_point::max();
      entry.connection->onTimer(now);
    });
  }
  if (now >= accept_again_) {
    setAccepting(true);
  }
}

void Reactor::runTurns() {
  const std::vector<std::uint64_t> turns = std::exchange(turns_, {});
  for (const std::uint64_t id : turns) {
    with(id, [](Entry& entry) { entry.connection->onTurn(); });
  }
}

// --- accepting ---

void Reactor::acceptClients() {
  for (int i = 0; i < kAcceptsAtOnce && listener_; ++i) {
    Accepted accepted = acceptClient(listener_);
    if (accepted.socket) {
      admitClient(std::move(accepted));
      continue;
    }
    if (accepted.fault == EMFILE || accepted.fault == ENFILE || accepted.fault == ENOBUFS ||
        accepted.fault == ENOMEM) {
      log_(LogLevel::kError, "no descriptors for more connections");
      setAccepting(false);
    }
    if (accepted.fault != EINTR && accepted.fault != ECONNABORTED) {
      return;
    }
  }
}

void Reactor::admitClient(Accepted accepted) {
  const bool is_counted = options_.count_loopback || !isLoopback(accepted.address);
  const auto of_address = per_address_.find(accepted.address);
  const char* refusal = nullptr;
  if (is_counted && of_address != per_address_.end() &&
      of_address->second >= options_.max_per_address) {
    refusal = "too many connections from this address";
  } else if (entries_.size() >= options_.max_connections && !makeRoom()) {
    refusal = "too many connections";
  }
  if (refusal == nullptr || entries_.size() < options_.max_connections + kTurnedAwayAtOnce) {
    addConnection(std::move(accepted), refusal);
  }
}

void Reactor::addConnection(Accepted accepted, const char* refusal) {
  const std::uint64_t id = next_id_++;
  Entry& entry = entries_[id];
  ++per_address_[accepted.address];
  const int socket = accepted.socket.get();
  entry.connection =
      std::make_unique<Connection>(id, std::move(accepted.socket), accepted.address, *context_);
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.u64 = id;
  entry.armed = EPOLLIN;
  if (::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, socket, &event) != 0) {
    remove(id);
    return;
  }
  with(id, [refusal](Entry& added) {
    if (refusal != nullptr) {
      added.connection->turnAway(Error(ErrorCode::kRequestBusy, refusal, {"", 0, 0, "connection"}));
    }
  });
}

// Closes the connection that has been idle for longest. @returns false if none has been for a while
bool Reactor::makeRoom() {
  const Entry* oldest = nullptr;
  std::uint64_t oldest_id = 0;
  for (const auto& [id, entry] : entries_) {
    if (entry.connection->isIdle() &&
        (oldest == nullptr || entry.connection->idle_since() < oldest->connection->idle_since())) {
      oldest = &entry;
      oldest_id = id;
    }
  }
  if (oldest == nullptr || Clock::now() - oldest->connection->idle_since() < kIdleBeforeEviction) {
    return false;
  }
  remove(oldest_id);
  return true;
}

void Reactor::setAccepting(bool accepting) {
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.u64 = kListenerId;
  ::epoll_ctl(epoll_.get(), accepting ? EPOLL_CTL_ADD : EPOLL_CTL_DEL, listener_.get(), &event);
  accept_again_ = accepting ? Clock::time_point::max() : Clock::now() + kAcceptPause;
}

// --- connections ---

void Reactor::beginStop() {
  context_->stopping = true;
  listener_.reset();
  accept_again_ = Clock::time_point::max();
  stop_at_ = Clock::now() + options_.stop_limit;
  std::vector<std::uint64_t> ids;
  for (const auto& [id, entry] : entries_) {
    ids.push_back(id);
  }
  for (const std::uint64_t id : ids) {
    with(id, [](Entry& entry) { entry.connection->onStop(); });
  }
}

// Lets a connection do something, then waits for what it wants next. One that fails is dropped:
// the others live on.
template <class Step>
void Reactor::with(std::uint64_t id, Step step) {
  const auto found = entries_.find(id);
  if (found == entries_.end()) {
    return;
  }
  try {
    step(found->second);
    settle(id, found->second);
  } catch (const std::exception& error) {
    log_(LogLevel::kError, std::string("a connection is dropped: ") + error.what());
    remove(id);
  }
}

void Reactor::settle(std::uint64_t id, Entry& entry) {
  const Connection& connection = *entry.connection;
  if (connection.finished()) {
    remove(id);
    return;
  }
  const std::uint32_t wanted = connection.interest();
  if (wanted != entry.armed && !(connection.toleratesInput() && entry.armed == EPOLLIN)) {
    arm(id, entry, wanted);
  }
  // A timer that rings too early is set again then: cheaper than moving it with every byte.
  if (connection.due() < entry.timer) {
    setTimer(id, entry, connection.due());
  }
  setTopic(id, entry, connection.topic());
  if (connection.wantsTurn()) {
    turns_.push_back(id);
  }
}

void Reactor::arm(std::uint64_t id, Entry& entry, std::uint32_t events) {
  epoll_event event{};
  event.events = events;
  event.data.u64 = id;
  check(::epoll_ctl(epoll_.get(), EPOLL_CTL_MOD, entry.connection->socket(), &event) == 0,
        "a connection cannot be waited for");
  entry.armed = events;
}

void Reactor::setTimer(std::uint64_t id, Entry& entry, Clock::time_point time) {
  timers_.erase({entry.timer, id});
  entry.timer = time;
  if (time != Clock::time_point::max()) {
    timers_.insert({time, id});
  }
}

void Reactor::setTopic(std::uint64_t id, Entry& entry, const Topic& topic) {
  if (topic == entry.topic) {
    return;
  }
  if (const auto found = watchers_.find(entry.topic); found != watchers_.end()) {
    found->second.erase(id);
    if (found->second.empty()) {
      watchers_.erase(found);
    }
  }
  entry.topic = topic;
  if (!topic.empty()) {
    watchers_[topic].insert(id);
  }
}

void Reactor::remove(std::uint64_t id) {
  const auto found = entries_.find(id);
  if (found == entries_.end()) {
    return;
  }
  Entry& entry = found->second;
  setTimer(id, entry, Clock::time_point::max());
  setTopic(id, entry, "");
  if (entry.connection) {
    const auto count = per_address_.find(entry.connection->client());
    if (count != per_address_.end() && --count->second == 0) {
      per_address_.erase(count);
    }
  }
  entries_.erase(found);
}

void Reactor::publishLoad() {
  load_connections_ = entries_.size();
  load_streams_ = context_->event_streams;
  load_parked_ = context_->parked;
  load_queued_ = pool_ ? pool_->queued() : 0;
}

}  // namespace gaitmill::api

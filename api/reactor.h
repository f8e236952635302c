#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "api/body_store.h"
#include "api/connection.h"
#include "api/gate.h"
#include "api/handler_pool.h"
#include "api/listener.h"
#include "api/mailbox.h"
#include "api/router.h"
#include "api/server.h"

namespace gaitmill::api {

/// The one thread that owns all sockets. It waits in epoll for bytes, deadlines, answers of handler
/// threads and notices, and lets connections do what they can. An idle connection, a slow drip or a
/// slow reader costs a descriptor and a buffer here, never a thread.
class Reactor {
 public:
  Reactor(std::vector<Route> routes, ServerOptions options, ServerLog log);
  ~Reactor();
  Reactor(const Reactor&) = delete;
  Reactor& operator=(const Reactor&) = delete;

  int bind();
  void run();
  void stop();
  void notify(const Topic& topic);
  ServerLoad load() const;

 private:
  struct Entry {
    std::unique_ptr<Connection> connection;
    std::uint32_t armed = 0;                             ///< what epoll waits for
    Clock::time_point timer = Clock::time_point::max();  ///< its place in timers_
    Topic topic;                                         ///< its place in watchers_
  };

  void wake() const;
  void serve();
  void waitForEvents();
  int findTimeout() const;
  void onEvent(std::uint64_t id, std::uint32_t events);
  void takeMail();
  void onNotice(const Notice& notice);
  void runTimers();
  void runTurns();

  void acceptClients();
  void admitClient(Accepted accepted);
  void addConnection(Accepted accepted, const char* refusal);
  bool makeRoom();
  void setAccepting(bool accepting);

  void beginStop();
  template <class Step>
  void with(std::uint64_t id, Step step);
  void settle(std::uint64_t id, Entry& entry);
  void arm(std::uint64_t id, Entry& entry, std::uint32_t events);
  void setTimer(std::uint64_t id, Entry& entry, Clock::time_point time);
  void setTopic(std::uint64_t id, Entry& entry, const Topic& topic);
  void remove(std::uint64_t id);
  void publishLoad();

  ServerOptions options_;
  ServerLog log_;
  Router router_;
  Gate gate_;
  BodyStore bodies_;
  Descriptor epoll_;
  Descriptor wake_;
  Descriptor listener_;
  Mailbox mailbox_;
  NoticeLog notices_;
  std::unique_ptr<HandlerPool> pool_;
  std::unique_ptr<TransportContext> context_;
  std::unordered_map<std::uint64_t, Entry> entries_;
  std::set<std::pair<Clock::time_point, std::uint64_t>> timers_;
  std::map<Topic, std::set<std::uint64_t>> watchers_;
  std::unordered_map<std::string, std::size_t> per_address_;
  std::vector<std::uint64_t> turns_;
  std::uint64_t next_id_;
  Clock::time_point accept_again_ = Clock::time_point::max();  ///< while descriptors have run out
  Clock::time_point stop_at_ = Clock::time_point::max();
  std::atomic<bool> stop_asked_{false};
  std::atomic<std::size_t> load_connections_{0};
  std::atomic<std::size_t> load_streams_{0};
  std::atomic<std::size_t> load_parked_{0};
  std::atomic<std::size_t> load_queued_{0};
};

}  // namespace gaitmill::api

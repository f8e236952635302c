#include "tests/bench/load/connection_ring.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <deque>
#include <stdexcept>

namespace gaitmill::load {

namespace {

// A client in its circle of request and answer.
struct Client {
  int socket = -1;
  std::string in;
  Clock::time_point begin;
};

// Size of the answer at the front of `in`, 0 while it is incomplete.
std::size_t findAnswerSize(const std::string& in) {
  const std::size_t end = in.find("\r\n\r\n");
  if (end == std::string::npos) {
    return 0;
  }
  const std::size_t field = in.find("Content-Length: ");
  const std::size_t length =
      field == std::string::npos || field > end ? 0 : std::stoull(in.substr(field + 16, 20));
  return in.size() >= end + 4 + length ? end + 4 + length : 0;
}

class Ring {
 public:
  Ring(const RingOptions& options, const std::function<std::string(std::uint64_t)>& make_request)
      : options_(options), make_request_(make_request), epoll_(::epoll_create1(EPOLL_CLOEXEC)) {}
  ~Ring() {
    for (const Client& client : clients_) {
      ::close(client.socket);
    }
    ::close(epoll_);
  }
  Ring(const Ring&) = delete;
  Ring& operator=(const Ring&) = delete;

  Figures run() {
    clients_.resize(static_cast<std::size_t>(options_.connections));
    begin_ = Clock::now();
    for (std::size_t i = 0; i < clients_.size(); ++i) {
      open(i);
    }
    while (secondsSinceBegin() < options_.seconds) {
      beginFree();
      step();
    }
    figures_.seconds = secondsSinceBegin();
    return std::move(figures_);
  }

 private:
  void open(std::size_t index) {
    Client& client = clients_[index];
    client.socket = connectTo(options_.port);
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.u64 = index;
    ::epoll_ctl(epoll_, EPOLL_CTL_ADD, client.socket, &event);
    free_.push_back(index);
  }

  double secondsSinceBegin() const {
    return std::chrono::duration<double>(Clock::now() - begin_).count();
  }

  // When the next request is to be sent.
  Clock::time_point findMoment(Clock::time_point now) const {
    if (options_.rate <= 0) {
      return now;
    }
    const std::chrono::duration<double> since(static_cast<double>(number_) / options_.rate);
    return begin_ + std::chrono::duration_cast<Clock::duration>(since);
  }

  void beginFree() {
    const Clock::time_point now = Clock::now();
    while (!free_.empty() && findMoment(now) <= now) {
      Client& client = clients_[free_.front()];
      free_.pop_front();
      begin(client, findMoment(now));
    }
  }

  // Requests are small enough for the socket's buffer.
  void begin(Client& client, Clock::time_point moment) {
    const std::string request = make_request_(number_++);
    client.in.clear();
    client.begin = moment;
    std::size_t sent = 0;
    while (sent < request.size()) {
      const ssize_t count =
          ::send(client.socket, request.data() + sent, request.size() - sent, MSG_NOSIGNAL);
      if (count <= 0) {
        return;  // the reading side sees the end
      }
      sent += static_cast<std::size_t>(count);
    }
  }

  void step() {
    std::array<epoll_event, 64> events{};
    const int count = ::epoll_wait(epoll_, events.data(), static_cast<int>(events.size()), 1);
    for (int i = 0; i < count; ++i) {
      receive(static_cast<std::size_t>(events[static_cast<std::size_t>(i)].data.u64));
    }
  }

  void receive(std::size_t index) {
    Client& client = clients_[index];
    std::array<char, 65536> bytes{};
    const ssize_t got = ::recv(client.socket, bytes.data(), bytes.size(), 0);
    if (got <= 0) {
      ++figures_.failed;
      ::close(client.socket);
      open(index);
      return;
    }
    client.in.append(bytes.data(), static_cast<std::size_t>(got));
    if (findAnswerSize(client.in) > 0) {
      note(client);
      free_.push_back(index);
    }
  }

  void note(const Client& client) {
    const int status = std::stoi(client.in.substr(9, 3));
    if (status < 400) {
      figures_.latencies_ms.push_back(
          std::chrono::duration<double, std::milli>(Clock::now() - client.begin).count());
      return;
    }
    if (figures_.refused++ == 0) {
      figures_.first_refusal = status;
    }
  }

  const RingOptions options_;
  const std::function<std::string(std::uint64_t)>& make_request_;
  int epoll_;
  std::uint64_t number_ = 0;
  std::vector<Client> clients_;
  std::deque<std::size_t> free_;  ///< clients without a request under way
  Clock::time_point begin_;
  Figures figures_;
};

}  // namespace

double Figures::findQuantile(double share) {
  if (latencies_ms.empty()) {
    return -1;
  }
  const auto at = static_cast<std::size_t>(share * static_cast<double>(latencies_ms.size() - 1));
  const auto place = latencies_ms.begin() + static_cast<std::ptrdiff_t>(at);
  std::nth_element(latencies_ms.begin(), place, latencies_ms.end());
  return *place;
}

std::string Figures::describe(const std::string& name) {
  std::array<char, 300> text{};
  std::snprintf(text.data(),
                text.size(),
                "%s: %.0f per second, p50 %.2f ms, p99 %.2f ms, max %.2f ms; %llu refused (first "
                "%d), %llu broken, %.1f s",
                name.c_str(),
                static_cast<double>(latencies_ms.size()) / seconds,
                findQuantile(0.5),
                findQuantile(0.99),
                findQuantile(1.0),
                static_cast<unsigned long long>(refused),
                first_refusal,
                static_cast<unsigned long long>(failed),
                seconds);
  return text.data();
}

Figures runRing(const RingOptions& options,
                const std::function<std::string(std::uint64_t)>& make_request) {
  return Ring(options, make_request).run();
}

int connectTo(int port) {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    throw std::runtime_error("cannot connect to port " + std::to_string(port));
  }
  const int yes = 1;
  ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  return socket;
}

}  // namespace gaitmill::load

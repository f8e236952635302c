// Load on a running service, measured: gaitmill_load polls|submit|upload|crowd --port P …
// Not run by ctest. The bars are those of the service's specification: 2 000 status polls per
// second with p99 <= 25 ms and 300 durable submissions per second while both cores compute, a 200
// MB upload within 150 MB of memory, /livez within 500 ms among 2 000 idle and 200 dripping
// connections.

#include <sys/socket.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "api/listener.h"
#include "tests/api/transport/transport_server.h"
#include "tests/bench/load/connection_ring.h"

namespace gaitmill::load {
namespace {

using std::chrono::milliseconds;

constexpr const char* kBoundary = "gaitmill-load-boundary";

struct Options {
  int port = 8080;
  std::string path = "/livez";
  std::string method = "POST";
  std::vector<std::string> headers;
  std::string body;                // text, or @file
  std::vector<std::string> parts;  // name=text or name=@file
  std::string type = "application/json";
  int connections = 32;
  double seconds = 10;
  double rate = 0;
  int idle = 2000;
  int drips = 200;
  std::string drip_path = "/v1/trials";
  std::size_t bytes = 200'000'000;
  int pid = 0;
};

std::string readText(const std::string& text) {
  if (text.empty() || text.front() != '@') {
    return text;
  }
  std::ifstream file(text.substr(1), std::ios::binary);
  if (!file) {
    throw std::runtime_error("cannot read " + text.substr(1));
  }
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string makeMultipart(const std::vector<std::string>& parts) {
  std::string body;
  for (const std::string& part : parts) {
    const std::size_t equals = part.find('=');
    const std::string name = part.substr(0, equals);
    const std::string value = part.substr(equals + 1);
    const std::string file_name =
        value.substr(0, 1) == "@" ? value.substr(value.rfind('/') + 1) : "";
    body += std::string("--") + kBoundary + "\r\nContent-Disposition: form-data; name=\"" + name +
            "\"" + (file_name.empty() ? "" : "; filename=\"" + file_name + "\"") + "\r\n\r\n" +
            readText(value) + "\r\n";
  }
  return body + "--" + kBoundary + "--\r\n";
}

std::string makeHead(const Options& options, const std::string& method, std::size_t length) {
  std::string head = method + " " + options.path + " HTTP/1.1\r\nHost: load\r\n";
  for (const std::string& header : options.headers) {
    head += header + "\r\n";
  }
  if (method != "GET") {
    head += "Content-Type: " +
            (options.parts.empty() ? options.type
                                   : std::string("multipart/form-data; boundary=") + kBoundary) +
            "\r\nContent-Length: " + std::to_string(length) + "\r\n";
  }
  return head;
}

RingOptions makeRing(const Options& options, int connections) {
  return {options.port, connections, options.seconds, options.rate};
}

void measurePolls(const Options& options) {
  const std::string request = makeHead(options, "GET", 0) + "\r\n";
  Figures figures =
      runRing(makeRing(options, options.connections), [&](std::uint64_t) { return request; });
  std::cout << figures.describe("polls of " + options.path) << "\n";
}

void measureSubmissions(const Options& options) {
  const std::string body =
      options.parts.empty() ? readText(options.body) : makeMultipart(options.parts);
  const std::string head = makeHead(options, options.method, body.size());
  const std::string run = std::to_string(::getpid());
  Figures figures = runRing(makeRing(options, options.connections), [&](std::uint64_t number) {
    return head + "Idempotency-Key: load-" + run + "-" + std::to_string(number) + "\r\n\r\n" + body;
  });
  std::cout << figures.describe("submissions to " + options.path) << "\n";
}

// Resident memory of a process [MB].
double readResident(int pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/statm");
  double total = 0;
  double resident = 0;
  file >> total >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1e6;
}

// The peak of a process's resident memory while it lives [MB].
class ResidentTrace {
 public:
  explicit ResidentTrace(int pid) : begin_(readResident(pid)), peak_(begin_) {
    thread_ = std::thread([this, pid] {
      while (!ended_) {
        peak_ = std::max(peak_.load(), readResident(pid));
        std::this_thread::sleep_for(milliseconds(5));
      }
    });
  }
  ~ResidentTrace() { end(); }
  ResidentTrace(const ResidentTrace&) = delete;
  ResidentTrace& operator=(const ResidentTrace&) = delete;

  void end() {
    ended_ = true;
    if (thread_.joinable()) {
      thread_.join();
    }
  }
  double begin() const { return begin_; }
  double peak() const { return peak_; }

 private:
  double begin_;
  std::atomic<double> peak_;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

void sendAll(int socket, const std::string& bytes) {
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t count = ::send(socket, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (count <= 0) {
      throw std::runtime_error("the service closed the connection");
    }
    sent += static_cast<std::size_t>(count);
  }
}

std::string receiveAnswer(int socket) {
  std::array<char, 4096> answer{};
  const ssize_t got = ::recv(socket, answer.data(), answer.size(), 0);
  return {answer.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0))};
}

void measureUpload(const Options& options) {
  std::string body = options.parts.empty() ? readText(options.body) : makeMultipart(options.parts);
  if (body.empty()) {
    body.assign(options.bytes, 'x');
  }
  ResidentTrace trace(options.pid);
  const Clock::time_point begin = Clock::now();
  const int socket = connectTo(options.port);
  sendAll(socket, makeHead(options, options.method, body.size()) + "\r\n");
  sendAll(socket, body);
  const std::string answer = receiveAnswer(socket);
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  ::close(socket);
  trace.end();
  std::cout << "upload of " << static_cast<double>(body.size()) / 1e6 << " MB: answer "
            << answer.substr(9, 3) << " after " << seconds << " s; resident " << trace.begin()
            << " MB before, " << trace.peak() << " MB at most, " << trace.peak() - trace.begin()
            << " MB above\n";
}

class Crowd {
 public:
  explicit Crowd(const Options& options) {
    for (int i = 0; i < options.idle; ++i) {
      idle_.push_back(connectTo(options.port));
    }
    const std::string body_head = "POST " + options.drip_path +
                                  " HTTP/1.1\r\nHost: load\r\nContent-Type: multipart/form-data; "
                                  "boundary=x\r\nContent-Length: 900000\r\n";
    for (int i = 0; i < options.drips; ++i) {
      drips_.push_back(connectTo(options.port));
      std::string begin = i % 2 == 0 ? "GET /livez HTTP/1.1\r\nHost: load\r\nA: " : body_head;
      for (const std::string& header : options.headers) {
        begin += i % 2 == 0 ? "" : header + "\r\n";
      }
      sendAll(drips_.back(), begin + (i % 2 == 0 ? "" : "\r\n"));
    }
  }
  ~Crowd() {
    for (const int socket : idle_) {
      ::close(socket);
    }
    for (const int socket : drips_) {
      ::close(socket);
    }
  }
  Crowd(const Crowd&) = delete;
  Crowd& operator=(const Crowd&) = delete;

  // The service drops drips in the end: then sending fails, which is as it should be.
  void drip() const {
    for (const int socket : drips_) {
      ::send(socket, "a", 1, MSG_NOSIGNAL);
    }
  }

 private:
  std::vector<int> idle_;
  std::vector<int> drips_;
};

void measureCrowd(const Options& options) {
  const Crowd crowd(options);
  std::atomic<bool> ended{false};
  std::thread dripping([&] {
    while (!ended) {
      crowd.drip();
      std::this_thread::sleep_for(milliseconds(50));
    }
  });
  const std::string request = makeHead(options, "GET", 0) + "\r\n";
  Figures figures = runRing(makeRing(options, 1), [&](std::uint64_t) { return request; });
  ended = true;
  dripping.join();
  std::cout << figures.describe(options.path + " among " + std::to_string(options.idle) +
                                " idle and " + std::to_string(options.drips) + " dripping")
            << "\n";
}

// The transport alone, with the stub routes of its tests.
void serveStub(const Options& options) {
  api::TransportState state;
  api::ServerOptions server_options;
  server_options.port = options.port;
  api::Server server(
      api::makeTransportRoutes(state), server_options, [](api::LogLevel, const std::string&) {});
  std::cout << "port " << server.bind() << std::endl;
  server.run();
}

void addCommands(CLI::App& app, Options& options) {
  app.require_subcommand(1);
  app.add_option("--port", options.port, "of the service on 127.0.0.1");
  app.add_option("--path", options.path, "of the request");
  app.add_option("--header", options.headers, "\"Name: value\", as often as needed");
  app.add_option("--seconds", options.seconds, "to measure");
  app.add_option("--rate", options.rate, "of requests per second; 0 = as fast as answers come");
  app.add_option("--connections", options.connections, "at once");
  app.add_option("--method", options.method, "of a submission or upload");
  app.add_option("--body", options.body, "text, or @file");
  app.add_option("--type", options.type, "Content-Type of the body");
  app.add_option("--part", options.parts, "name=text or name=@file of a multipart body");
  app.add_option("--bytes", options.bytes, "of an upload without body");
  app.add_option("--pid", options.pid, "of the service, for its memory");
  app.add_option("--idle", options.idle, "idle connections of the crowd");
  app.add_option("--drips", options.drips, "dripping connections of the crowd");
  app.add_option("--drip-path", options.drip_path, "of dripped multipart bodies");
  const auto add = [&](const char* name, const char* help, void (*measure)(const Options&)) {
    app.add_subcommand(name, help)->fallthrough()->callback([&options, measure] {
      measure(options);
    });
  };
  add("polls", "GET as fast as answers come", measurePolls);
  add("submit", "submissions with an Idempotency-Key each", measureSubmissions);
  add("upload", "one large body, with the service's memory", measureUpload);
  add("crowd", "GET among idle and dripping connections", measureCrowd);
  add("stub", "serves the stub routes of the transport's tests", serveStub);
}

}  // namespace
}  // namespace gaitmill::load

int main(int argc, char** argv) {
  gaitmill::load::Options options;
  CLI::App app("Load on a running gaitmill service");
  gaitmill::load::addCommands(app, options);
  gaitmill::api::raiseFileLimit(10'000);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}

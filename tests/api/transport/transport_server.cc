#include "tests/api/transport/transport_server.h"

#include <chrono>

namespace gaitmill::api {

namespace {

using std::chrono::milliseconds;

HttpReply replyText(std::string text) {
  HttpReply reply;
  reply.content_type = "text/plain";
  reply.body = std::move(text);
  return reply;
}

HttpReply describeParts(const HttpRequest& request) {
  std::string text;
  for (const BodyPart& part : request.parts) {
    text += part.name + "=" + part.file_name + ":" + std::to_string(part.bytes->size()) + ":" +
            readAll(*part.bytes, 100).substr(0, 20) + ";";
  }
  return replyText(text);
}

// Whether the body is the pattern from its first byte on.
HttpReply checkPattern(const HttpRequest& request) {
  constexpr std::size_t kPiece = 1U << 20U;
  std::uint64_t at = 0;
  while (at < request.body->size()) {
    const std::string piece = request.body->read(at, kPiece);
    if (piece.empty() || piece != makePattern(at, piece.size())) {
      return replyText("differs");
    }
    at += piece.size();
  }
  return replyText("same " + std::to_string(at));
}

HttpReply waitForJob(TransportState& state, const HttpRequest& request) {
  ++state.asked;
  if (state.is_final || request.wait_is_over) {
    return replyText(state.is_final ? "final" : "running");
  }
  HttpReply reply;
  reply.park = Park{"job_1", milliseconds(std::stoi(request.query.at("ms")))};
  return reply;
}

HttpReply streamEvents(TransportState& state) {
  HttpReply reply;
  EventFeed feed;
  feed.topic = "job_1";
  feed.next = [&state](bool& ended) {
    ++state.asked;
    const std::lock_guard lock(state.mutex);
    std::string text;
    for (const std::string& event : state.events) {
      text += "data: " + event + "\n\n";
      ended = ended || event == "end";
    }
    state.events.clear();
    return text;
  };
  reply.events = std::move(feed);
  return reply;
}

HttpReply replyLarge(const std::string& tag) {
  HttpReply reply;
  reply.content_type = "application/octet-stream";
  reply.source = std::make_shared<PatternSource>(kLargeBytes);
  reply.headers["ETag"] = tag;
  return reply;
}

HttpReply replyTable() {
  HttpReply reply;
  reply.body = "[" + std::string(20'000, '1') + "]";
  reply.headers["ETag"] = "\"table\"";
  return reply;
}

HttpReply count(TransportState& state, HttpReply reply) {
  ++state.calls;
  return reply;
}

void addReadRoutes(TransportState& state, std::vector<Route>& routes) {
  const auto get = [&routes](const std::string& pattern, auto handle, Scope scope = Scope::kNone) {
    routes.push_back({"GET", pattern, BodyKind::kNone, handle, scope});
  };
  get("/livez", [](HttpRequest&) { return replyText("ok"); });
  get("/items/{id}", [&state](HttpRequest& request) {
    return count(state, replyText(request.captures.at("id") + " " + request.query["q"]));
  });
  get("/large", [](HttpRequest&) { return replyLarge("\"large\""); });
  get("/table", [](HttpRequest&) { return replyTable(); });
  get("/held", [&state](HttpRequest&) {
    state.latch.wait();
    return replyText("released");
  });
  get("/fails", [](HttpRequest&) -> HttpReply { throw std::runtime_error("as the test wants"); });
  get("/wait", [&state](HttpRequest& request) { return waitForJob(state, request); });
  get("/events", [&state](HttpRequest&) { return streamEvents(state); });
  get("/echo", [](HttpRequest& request) {
    HttpReply reply = replyText(request.id);
    reply.headers["X-Echo"] = request.query["v"];
    return reply;
  });
  get(
      "/secret",
      [](HttpRequest& request) { return replyText(request.identity.tenant); },
      Scope::kRead);
}

void addWriteRoutes(TransportState& state, std::vector<Route>& routes) {
  const auto add = [&routes](const std::string& method,
                             const std::string& pattern,
                             BodyKind body,
                             auto handle,
                             Scope scope = Scope::kNone) {
    routes.push_back({method, pattern, body, handle, scope});
  };
  const auto echoBody = [&state](HttpRequest& request) {
    return count(state, replyText(readAll(*request.body, 1U << 20U)));
  };
  const auto parts = [&state](HttpRequest& request) {
    return count(state, describeParts(request));
  };
  const auto pattern = [&state](HttpRequest& request) {
    return count(state, checkPattern(request));
  };
  add("POST", "/json", BodyKind::kJson, echoBody);
  add("POST", "/parts", BodyKind::kMultipart, parts);
  add("POST", "/either", BodyKind::kMultipartOrJson, parts);
  add("PUT", "/bytes/{name}", BodyKind::kBytes, pattern);
  add("DELETE", "/items/{id}", BodyKind::kNone, [&state](HttpRequest&) {
    HttpReply reply;
    reply.status = 204;
    return count(state, reply);
  });
  add("POST", "/secret", BodyKind::kBytes, pattern, Scope::kWrite);
  add("DELETE", "/secret", BodyKind::kNone, pattern, Scope::kAdmin);
}

}  // namespace

std::vector<Route> makeTransportRoutes(TransportState& state) {
  std::vector<Route> routes;
  addReadRoutes(state, routes);
  addWriteRoutes(state, routes);
  return routes;
}

TransportServer::TransportServer(ServerOptions options) {
  if (!options.on_request) {
    options.on_request = [this](const RequestRecord& record) {
      const std::lock_guard lock(state_.mutex);
      state_.records.push_back(record);
    };
  }
  server_ = std::make_unique<Server>(makeTransportRoutes(state_),
                                     std::move(options),
                                     [this](LogLevel level, const std::string& line) {
                                       if (level == LogLevel::kError) {
                                         const std::lock_guard lock(state_.mutex);
                                         state_.errors.push_back(line);
                                       }
                                     });
  port_ = server_->bind();
  thread_ = std::thread([this] { server_->run(); });
}

TransportServer::~TransportServer() {
  state_.latch.open();
  stop();
}

void TransportServer::stop() {
  server_->stop();
  if (thread_.joinable()) {
    thread_.join();
  }
}

RawReply TransportServer::ask(const std::string& request) const {
  RawClient client(port_);
  client.send(request);
  return client.read();
}

bool TransportServer::awaitLoad(const std::function<bool(const ServerLoad&)>& is_wanted) const {
  for (int i = 0; i < 5000; ++i) {
    if (is_wanted(server_->load())) {
      return true;
    }
    std::this_thread::sleep_for(milliseconds(2));
  }
  return false;
}

}  // namespace gaitmill::api

#include "api/server.h"

#include <sys/socket.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <optional>
#include <thread>
#include <utility>

#include <httplib.h>

#include "api/connection_stream.h"
#include "api/errors.h"
#include "core/base/error.h"

namespace gaitmill::api {

namespace {

constexpr int kBacklog = 512;                 // the library's own 5 turns bursts of clients away
constexpr std::size_t kMaxRequests = 10'000;  // per connection
constexpr std::chrono::milliseconds kStopPoll{50};

std::string toLower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  return text;
}

// "Application/JSON; charset=utf-8" -> "application/json"
std::string findMediaType(const httplib::Request& request) {
  std::string type = request.get_header_value("Content-Type");
  type.erase(std::min(type.find(';'), type.size()));
  type.erase(std::find_if(type.begin(), type.end(), [](char c) { return c == ' ' || c == '\t'; }),
             type.end());
  return toLower(type);
}

// Digits only, one header: anything else is how requests are smuggled.
std::optional<std::uint64_t> findContentLength(const httplib::Request& request) {
  const std::string text = request.get_header_value("Content-Length");
  const bool is_number =
      !text.empty() && text.size() <= 18 &&
      std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  require(request.get_header_value_count("Content-Length") <= 1 &&
              (is_number || !request.has_header("Content-Length")),
          ErrorCode::kRequestMalformed,
          "Content-Length must be one number",
          {"", 0, 0, "Content-Length"});
  return is_number ? std::optional<std::uint64_t>(std::stoull(text)) : std::nullopt;
}

std::string joinNames(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) {
    list += (list.empty() ? "" : ", ") + name;
  }
  return list;
}

std::string routedMethod(const httplib::Request& request) {
  return request.method == "HEAD" ? "GET" : request.method;
}

void send(const HttpReply& reply, httplib::Response& response) {
  response.status = reply.status;
  for (const auto& [name, value] : reply.headers) {
    response.set_header(name, value);
  }
  response.set_header("X-Content-Type-Options", "nosniff");
  response.set_content(reply.source ? readAll(*reply.source, reply.source->size()) : reply.body,
                       reply.content_type);
}

// Faults that the library finds by itself reach us as a bare status.
HttpReply replyBareStatus(int status) {
  switch (status) {
    case 413:
      return replyError(Error(ErrorCode::kRequestTooLarge, "the body is too large"));
    case 404:
      return replyError(Error(ErrorCode::kRequestNotFound, "there is nothing at this path"));
    case 500:
      return replyError(Error(ErrorCode::kInternal, "request handling failed"));
    default:
      HttpReply reply =
          replyError(Error(ErrorCode::kRequestMalformed, "the request is not valid HTTP/1.1"));
      reply.status = status;
      return reply;
  }
}

}  // namespace

// The library's server with our connection handling. All methods lead to dispatch().
class Server::Transport : public httplib::Server {
 public:
  Transport(std::vector<Route> routes, ServerOptions options, ServerLog log)
      : router_(std::move(routes)), options_(std::move(options)), log_(std::move(log)) {
    setLimits();
    setGates();
    Get(".*", [this](const httplib::Request& request, httplib::Response& response) {
      dispatch(request, response, nullptr);
    });
    const auto read_and_dispatch = [this](const httplib::Request& request,
                                          httplib::Response& response,
                                          const httplib::ContentReader& reader) {
      dispatch(request, response, &reader);
    };
    Post(".*", read_and_dispatch);
    Put(".*", read_and_dispatch);
    Delete(".*", [this](const httplib::Request& request, httplib::Response& response) {
      dispatch(request, response, nullptr);
    });
    set_logger([this](const httplib::Request& request, const httplib::Response& response) {
      log_(LogLevel::kDebug,
           request.method + " " + request.path + " " + std::to_string(response.status));
    });
  }

  int bindPort() {
    const int port = options_.port == 0                           ? bind_to_any_port(options_.host)
                     : bind_to_port(options_.host, options_.port) ? options_.port
                                                                  : -1;
    require(port > 0,
            ErrorCode::kServicePort,
            "cannot listen on " + options_.host + " port " + std::to_string(options_.port) +
                ": in use or not ours");
    ::listen(svr_sock_, kBacklog);
    return port;
  }

  void serve() {
    started_ = true;
    if (!stopping_) {
      listen_after_bind();
    }
    finished_ = true;
  }

  // The library forgets a stop that comes before it listens, so wait until it does.
  void stopServing() {
    stopping_ = true;
    while (started_ && !finished_ && !is_running()) {
      std::this_thread::sleep_for(kStopPoll);
    }
    stop();
  }

 private:
  void setLimits() {
    new_task_queue = [this] {
      return new httplib::ThreadPool(options_.threads);
    };
    set_tcp_nodelay(true);
    set_payload_max_length(options_.max_upload_bytes);
    // Without SO_REUSEPORT, which the library sets and which lets a second service share the port.
    set_socket_options([](socket_t socket) {
      const int yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
  }

  // What is asked before a body is read, and what is made of the library's own refusals.
  void setGates() {
    set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      return refuse(request, response) ? HandlerResponse::Handled : HandlerResponse::Unhandled;
    });
    set_expect_100_continue_handler(
        [this](const httplib::Request& request, httplib::Response& response) {
          return refuse(request, response) ? response.status : 100;
        });
    set_error_handler(HandlerWithResponse([](const httplib::Request&, httplib::Response& response) {
      if (!response.body.empty()) {
        return HandlerResponse::Unhandled;
      }
      send(replyBareStatus(response.status), response);
      return HandlerResponse::Handled;
    }));
  }

  bool process_and_close_socket(socket_t socket) override {
    ConnectionStream stream(socket, options_);
    for (std::size_t count = 1; count <= kMaxRequests; ++count) {
      if (!waitForRequest(stream)) {
        return true;
      }
      stream.beginHeaders();
      bool closed = false;
      const bool served = process_request(
          stream, count == kMaxRequests, closed, [&stream](httplib::Request& request) {
            beginBody(request, stream);
          });
      if (!served || closed || stream.hasUnreadBody()) {
        return served;
      }
    }
    return true;
  }

  // Ranges are dropped: the library would repeat the reply once for each of them.
  static void beginBody(httplib::Request& request, ConnectionStream& stream) {
    request.ranges.clear();
    const std::string length = request.get_header_value("Content-Length");
    const bool endless = request.has_header("Transfer-Encoding");
    stream.beginBody(endless ? UINT64_MAX : std::strtoull(length.c_str(), nullptr, 10));
  }

  bool waitForRequest(ConnectionStream& stream) const {
    const auto until = std::chrono::steady_clock::now() + options_.keep_alive;
    while (!stopping_ && std::chrono::steady_clock::now() < until) {
      if (stream.waitForRequest(kStopPoll)) {
        return true;
      }
    }
    return false;
  }

  // Everything that can be known from the headers alone.
  void checkHeaders(const httplib::Request& request, const RouteMatch& match) const {
    require(request.target.size() <= options_.max_target_bytes,
            ErrorCode::kRequestUriTooLong,
            "path and query may have " + std::to_string(options_.max_target_bytes) + " bytes");
    require(request.headers.size() <= options_.max_headers,
            ErrorCode::kRequestMalformed,
            "more than " + std::to_string(options_.max_headers) + " headers");
    require(!match.methods.empty(),
            ErrorCode::kRequestNotFound,
            "there is nothing at this path",
            {"", 0, 0, "path"});
    require(match.route != nullptr,
            ErrorCode::kRequestMethod,
            "this path takes " + joinNames(match.methods),
            {"", 0, 0, "method"});
    require(!request.has_header("Transfer-Encoding"),
            ErrorCode::kRequestLengthRequired,
            "send the body with Content-Length; Transfer-Encoding is not taken",
            {"", 0, 0, "Transfer-Encoding"});
    checkBody(request, *match.route);
  }

  void checkBody(const httplib::Request& request, const Route& route) const {
    const std::uint64_t length = findContentLength(request).value_or(0);
    const std::string type = findMediaType(request);
    const bool is_upload = route.body == BodyKind::kMultipart || route.body == BodyKind::kBytes ||
                           (route.body == BodyKind::kMultipartOrJson && type != "application/json");
    const std::uint64_t limit = is_upload ? options_.max_upload_bytes : options_.max_json_bytes;
    require(length <= limit,
            ErrorCode::kRequestTooLarge,
            "the body has " + std::to_string(length) + " bytes, " + std::to_string(limit) +
                " are allowed",
            {"", 0, 0, "Content-Length"});
    if (route.body == BodyKind::kNone) {
      return;
    }
    const std::string expected = is_upload ? "multipart/form-data" : "application/json";
    require((type == expected || route.body == BodyKind::kBytes) &&
                !request.has_header("Content-Encoding"),
            ErrorCode::kRequestMediaType,
            "the body must be " + expected + " without Content-Encoding",
            {"", 0, 0, "Content-Type"});
    require(length > 0,
            ErrorCode::kRequestLengthRequired,
            "the body is missing or has no Content-Length",
            {"", 0, 0, "Content-Length"});
  }

  bool refuse(const httplib::Request& request, httplib::Response& response) const {
    const RouteMatch match = router_.find(routedMethod(request), request.path);
    try {
      checkHeaders(request, match);
      return false;
    } catch (const Error& error) {
      HttpReply reply = replyError(error);
      if (error.code() == ErrorCode::kRequestMethod) {
        reply.headers["Allow"] = joinNames(match.methods);
      }
      reply.headers["Connection"] = "close";
      send(reply, response);
      return true;
    }
  }

  void dispatch(const httplib::Request& request,
                httplib::Response& response,
                const httplib::ContentReader* reader) const {
    const RouteMatch match = router_.find(routedMethod(request), request.path);
    try {
      check(match.route != nullptr, "a request without a route passed the gate");
      HttpRequest parsed = readRequest(request, match, reader);
      send(match.route->handle(parsed), response);
    } catch (const Error& error) {
      if (httpStatus(error.code()) >= 500) {
        log_(LogLevel::kError, request.method + " " + request.path + ": " + error.what());
      }
      send(replyError(error), response);
    } catch (const std::exception& error) {
      log_(LogLevel::kError, request.method + " " + request.path + ": " + error.what());
      send(replyError(Error(ErrorCode::kInternal, error.what())), response);
    }
  }

  HttpRequest readRequest(const httplib::Request& request,
                          const RouteMatch& match,
                          const httplib::ContentReader* reader) const {
    HttpRequest parsed;
    parsed.method = routedMethod(request);
    parsed.path = request.path;
    parsed.captures = match.captures;
    for (const auto& [name, value] : request.params) {
      parsed.query.emplace(name, value);
    }
    for (const auto& [name, value] : request.headers) {
      parsed.headers.emplace(toLower(name), value);
    }
    std::string body;
    if (reader != nullptr && findContentLength(request).value_or(0) > 0) {
      const bool complete = request.is_multipart_form_data() ? readParts(*reader, parsed.parts)
                                                             : readBody(*reader, body);
      require(complete,
              ErrorCode::kRequestMalformed,
              match.route->body == BodyKind::kMultipart
                  ? "the body is incomplete, not valid multipart/form-data, or has more than " +
                        std::to_string(options_.max_parts) + " parts"
                  : "the body is incomplete",
              {"", 0, 0, "body"});
    }
    parsed.body = makeByteSource(std::move(body));
    return parsed;
  }

  static bool readBody(const httplib::ContentReader& reader, std::string& body) {
    return reader([&body](const char* bytes, std::size_t size) {
      body.append(bytes, size);
      return true;
    });
  }

  bool readParts(const httplib::ContentReader& reader, std::vector<BodyPart>& parts) const {
    std::vector<std::string> contents;
    const bool complete = reader(
        [&](const httplib::MultipartFormData& part) {
          parts.push_back({part.name, part.filename, nullptr});
          contents.emplace_back();
          return parts.size() <= options_.max_parts;
        },
        [&contents](const char* bytes, std::size_t size) {
          contents.back().append(bytes, size);
          return true;
        });
    for (std::size_t i = 0; i < contents.size(); ++i) {
      parts[i].bytes = makeByteSource(std::move(contents[i]));
    }
    return complete;
  }

  Router router_;
  ServerOptions options_;
  ServerLog log_;
  std::atomic<bool> started_{false};
  std::atomic<bool> stopping_{false};
  std::atomic<bool> finished_{false};
};

Server::Server(std::vector<Route> routes, ServerOptions options, ServerLog log)
    : transport_(
          std::make_unique<Transport>(std::move(routes), std::move(options), std::move(log))) {}

Server::~Server() = default;

int Server::bind() {
  return transport_->bindPort();
}

void Server::run() {
  transport_->serve();
}

void Server::stop() {
  transport_->stopServing();
}

void Server::notify(const Topic&) {}

ServerLoad Server::load() const {
  return {};
}

}  // namespace gaitmill::api

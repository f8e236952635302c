// Every answer that openapi.yaml documents, provoked over a real socket and held against it.

#include <chrono>
#include <cstddef>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "api/routes.h"
#include "api/server.h"
#include "core/base/error.h"
#include "tests/api/stub_ports.h"
#include "tests/http/api_contract.h"
#include "tests/http/raw_client.h"

namespace gaitmill::api {
namespace {

using Answer = ApiContract::Answer;

constexpr const char* kOtherJobId = "job_01hf3v6k9e2m8xw7p0q4t5r6s2";
constexpr const char* kAllScopes = "Authorization: Bearer all\r\n";
constexpr const char* kNoScopes = "Authorization: Bearer none\r\n";

std::optional<Identity> authenticate(const std::string& authorization) {
  if (authorization == "Bearer all") {
    return Identity{};
  }
  if (authorization == "Bearer none") {
    return Identity{"local", kKeyId, false, false, false};
  }
  return std::nullopt;
}

/// The routes on stub ports behind a socket.
class StubServer {
 public:
  StubServer(StubPorts& stub, ServerOptions options)
      : server_(makeRoutes(stub.ports(), "1.2.3"),
                withKeys(std::move(options)),
                [](LogLevel, const std::string&) {}),
        port_(server_.bind()),
        thread_([this] { server_.run(); }) {}
  ~StubServer() {
    server_.stop();
    thread_.join();
  }
  StubServer(const StubServer&) = delete;
  StubServer& operator=(const StubServer&) = delete;

  // The reply to these bytes, which need not be a whole request.
  ClientReply ask(const std::string& bytes) const {
    RawClient client(port_);
    client.send(bytes);
    const RawReply reply = client.read();
    return {reply.status, reply.headers, reply.body};
  }

 private:
  static ServerOptions withKeys(ServerOptions options) {
    options.authenticate = authenticate;
    return options;
  }

  Server server_;
  int port_;
  std::thread thread_;
};

std::string replaceAll(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size()) {
    text.replace(at, what.size(), with);
  }
  return text;
}

bool startsWith(const std::string& text, const std::string& start) {
  return text.rfind(start, 0) == 0;
}

// The pattern with captures that its ports know.
std::string fillPattern(const std::string& pattern) {
  const std::string id = startsWith(pattern, "/v1/trials")    ? kTrialId
                         : startsWith(pattern, "/v1/jobs")    ? kJobId
                         : startsWith(pattern, "/v1/studies") ? kStudyId
                         : startsWith(pattern, "/v1/keys")    ? kKeyId
                                                              : kModelId;
  const std::string name = pattern.find("/results/") != std::string::npos ? "kinematics"
                           : pattern.find("/files/") != std::string::npos ? "ik.mot"
                                                                          : "angles";
  std::string path = replaceAll(pattern, "{id}", id);
  path = replaceAll(path, "{name}", name);
  path = replaceAll(path, "{part}", "markers");
  return replaceAll(path, "{code}", "trc.header");
}

ErrorCode findNotFoundCode(const std::string& pattern) {
  return startsWith(pattern, "/v1/trials")        ? ErrorCode::kTrialNotFound
         : startsWith(pattern, "/v1/jobs")        ? ErrorCode::kJobNotFound
         : startsWith(pattern, "/v1/compare")     ? ErrorCode::kJobNotFound
         : startsWith(pattern, "/v1/studies")     ? ErrorCode::kStudyNotFound
         : startsWith(pattern, "/v1/keys")        ? ErrorCode::kKeyNotFound
         : startsWith(pattern, "/v1/settings")    ? ErrorCode::kSettingsNotFound
         : startsWith(pattern, "/v1/marker_sets") ? ErrorCode::kMarkerSetNotFound
                                                  : ErrorCode::kModelNotFound;
}

/// A request that succeeds, to be bent until it fails.
struct Request {
  std::string method;
  std::string path;
  std::string query;    ///< with its '?', or empty
  std::string headers;  ///< besides those of the body
  std::string content_type;
  std::string body;

  bool hasBody() const { return !content_type.empty(); }
  std::string head() const {
    return method + " " + path + query + " HTTP/1.1\r\nHost: test\r\n" + headers;
  }
  std::string bytes() const {
    return hasBody() ? head() + "Content-Type: " + content_type +
                           "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body
                     : head() + "\r\n";
  }
};

Request makeGoodRequest(const std::string& method, const std::string& pattern) {
  Request request{method, fillPattern(pattern), "", kAllScopes, "", ""};
  const auto carry = [&](const char* type, const std::string& body) {
    request.content_type = type;
    request.body = body;
  };
  if (startsWith(pattern, "/v1/compare")) {
    request.query = std::string("?jobs=") + kJobId + "," + kOtherJobId;
  }
  const std::string operation = method + " " + pattern;
  if (operation == "POST /v1/trials") {
    carry("multipart/form-data; boundary=x",
          "--x\r\nContent-Disposition: form-data; name=\"trial\"\r\n\r\n"
          "{\"mass_kg\": 75.3, \"height_m\": 1.7}\r\n"
          "--x\r\nContent-Disposition: form-data; name=\"markers\"; filename=\"walk.trc\"\r\n\r\n"
          "bytes\r\n--x--\r\n");
  } else if (operation == "POST /v1/jobs") {
    carry("application/json", std::string(R"({"trial": ")") + kTrialId + "\"}");
    request.headers += "Prefer: wait=0\r\n";
  } else if (operation == "POST /v1/studies") {
    carry("application/json",
          std::string(R"({"name": "spring", "trials": [")") + kTrialId + "\"]}");
  } else if (operation == "POST /v1/keys") {
    carry("application/json", R"({"name": "lab", "scopes": ["read"]})");
  } else if (operation == "POST /v1/models" || operation == "POST /v1/marker_sets") {
    carry("application/octet-stream", "document");
    request.query = "?name=lab";
  } else if (method == "PUT") {
    carry("application/octet-stream", "bytes");
  }
  return request;
}

class ContractTest : public ::testing::Test {
 protected:
  void failWith(ErrorCode code) {
    stub_.record.failWith(Error(code, "as the test wants it", {"walk.trc", 3, 4, "RASI"}));
  }

  // The answer of this status, by the way that leads to it.
  ClientReply provoke(const Answer& answer, const std::string& media_type) {
    const auto& [method, pattern, status] = answer;
    Request request = makeGoodRequest(method, pattern);
    stub_.record.failWith(std::nullopt);
    if (status < 400) {
      return provokeSuccess(std::move(request), status, media_type);
    }
    switch (status) {
      case 408:
        return impatient_.ask("GET ");
      case 503:
        return busy_.ask(request.bytes());
      case 404:
      case 409:
      case 429:
      case 500:
      case 507:
        return provokePortError(std::move(request), pattern, status);
      default:
        return ready_.ask(bend(std::move(request), status));
    }
  }

  ClientReply provokeSuccess(Request request, int status, const std::string& media_type) {
    if (status == 200 && request.method == "POST") {
      request.query = "?validate=only";
    }
    if (!media_type.empty()) {
      request.headers += "Accept: " + media_type + "\r\n";
    }
    if (status == 206) {
      request.headers += "Range: bytes=1-2\r\n";
    }
    if (status == 304) {
      const ClientReply whole = ready_.ask(request.bytes());
      request.headers += "If-None-Match: " + whole.headers.at("etag") + "\r\n";
    }
    return ready_.ask(request.bytes());
  }

  ClientReply provokePortError(Request request, const std::string& pattern, int status) {
    if (status == 404 && startsWith(pattern, "/problems")) {
      request.path = "/problems/no.such_code";
      return ready_.ask(request.bytes());
    }
    failWith(status == 404   ? findNotFoundCode(pattern)
             : status == 409 ? ErrorCode::kJobState
             : status == 429 ? ErrorCode::kQuotaExceeded
             : status == 500 ? ErrorCode::kInternal
                             : ErrorCode::kStorageFull);
    return ready_.ask(request.bytes());
  }

  // The request, changed so that the transport or the route refuses it.
  static std::string bend(Request request, int status) {
    switch (status) {
      case 400:
        return request.head() + "no header\r\n\r\n";
      case 401:
        request.headers.clear();
        return request.bytes();
      case 403:
        request.headers = kNoScopes;
        return request.bytes();
      case 405:
        request.method = "PATCH";
        return request.bytes();
      case 406:
        request.query += request.query.empty() ? "?format=xml" : "&format=xml";
        return request.bytes();
      case 411:
        return request.head() + "Content-Type: " + request.content_type + "\r\n\r\n";
      case 413:
        return request.head() + "Content-Type: " + request.content_type +
               "\r\nContent-Length: 999999999999\r\n\r\n";
      case 414:
        request.query = "?x=" + std::string(5000, 'x');
        return request.bytes();
      case 415:
        request.headers += "Content-Encoding: gzip\r\n";
        return request.bytes();
      case 416:
        request.headers += "Range: bytes=999999-\r\n";
        return request.bytes();
      case 422:
        request.query = "?colour=red";
        return request.bytes();
      case 431:
        request.headers += replaceAll(std::string(200, '*'), "*", "A: b\r\n");
        return request.bytes();
      default:
        return request.bytes();
    }
  }

  static ServerOptions impatience() {
    ServerOptions options;
    options.header_deadline = std::chrono::milliseconds(20);
    return options;
  }
  static ServerOptions overload() {
    ServerOptions options;
    options.max_queued = 0;
    return options;
  }

  ApiContract contract_;
  StubPorts stub_;
  StubServer ready_{stub_, {}};
  StubServer impatient_{stub_, impatience()};
  StubServer busy_{stub_, overload()};
};

TEST_F(ContractTest, EveryDocumentedAnswerIsGivenAndFitsItsSchema) {
  for (const Answer& answer : contract_.listAnswers()) {
    const auto& [method, pattern, status] = answer;
    std::vector<std::string> media_types = contract_.listMediaTypes(answer);
    if (status >= 300 || media_types.empty()) {
      media_types = {""};
    }
    for (const std::string& media_type : media_types) {
      SCOPED_TRACE(method + " " + pattern + " " + std::to_string(status) + " " + media_type);
      const ClientReply reply = provoke(answer, media_type);
      EXPECT_EQ(reply.status, status) << reply.body;
      for (const auto& fault : contract_.findFaults(method, pattern, reply)) {
        ADD_FAILURE() << fault << "\n" << reply.body;
      }
      const auto type = reply.headers.find("content-type");
      if (type != reply.headers.end() && !media_type.empty()) {
        EXPECT_TRUE(startsWith(type->second, media_type)) << type->second;
      }
    }
  }
}

TEST_F(ContractTest, RouterAndDocumentHaveTheSameRoutes) {
  std::set<std::string> documented;
  for (const auto& [method, path, status] : contract_.listAnswers()) {
    documented.insert(method + " " + path);
  }
  std::set<std::string> routed;
  for (const Route& route : makeRoutes(stub_.ports(), "1")) {
    routed.insert(route.method + " " + route.pattern);
  }
  EXPECT_EQ(documented, routed);
}

// Whoever may not ask gets 401 and 403 on every route that has a scope, and on no other.
TEST_F(ContractTest, ScopesOfTheRoutesAreThoseOfTheDocument) {
  for (const Route& route : makeRoutes(stub_.ports(), "1")) {
    const bool is_guarded = contract_.listAnswers().count({route.method, route.pattern, 401}) == 1;
    EXPECT_EQ(route.scope != Scope::kNone, is_guarded) << route.method << " " << route.pattern;
    if (route.method != "GET") {
      EXPECT_TRUE(route.scope == Scope::kWrite || route.scope == Scope::kAdmin) << route.pattern;
    }
  }
}

TEST_F(ContractTest, DocumentIsServedAsItIs) {
  const ClientReply reply = ready_.ask(makeGet("/openapi.json"));
  EXPECT_EQ(nlohmann::json::parse(reply.body), contract_.document());
}

}  // namespace
}  // namespace gaitmill::api

#pragma once

#include <map>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "api/routes.h"
#include "core/base/error.h"
#include "tests/api/stub_ports.h"

namespace gaitmill::api {

/// Calls routes directly, on recording ports.
class RouteFixture : public ::testing::Test {
 protected:
  using Headers = std::map<std::string, std::string>;

  HttpReply call(const std::string& method, const std::string& path, HttpRequest request = {}) {
    return ask(method, path, request);
  }
  // The same on a request that the test goes on with, as after a park.
  HttpReply ask(const std::string& method, const std::string& path, HttpRequest& request) {
    const RouteMatch match = router_.find(method, path);
    check(match.route != nullptr, "the test asks for a route that there is not");
    request.method = method;
    request.path = path;
    request.id = "req_1";
    request.captures.insert(match.captures.begin(), match.captures.end());
    if (!request.body) {
      request.body = makeByteSource("");
    }
    return match.route->handle(request);
  }
  HttpReply get(const std::string& path, std::map<std::string, std::string> query = {}) {
    HttpRequest request;
    request.query = std::move(query);
    return call("GET", path, request);
  }
  HttpReply post(const std::string& path, const std::string& body, Headers headers = {}) {
    HttpRequest request;
    request.headers = std::move(headers);
    request.body = makeByteSource(body);
    return call("POST", path, request);
  }

  template <class Call>
  static Error errorOf(Call call) {
    try {
      call();
    } catch (const Error& error) {
      return error;
    }
    return {ErrorCode::kInternal, "nothing was thrown"};
  }

  StubPorts stub_;
  Router router_{makeRoutes(stub_.ports(), "1.2.3")};
  const std::string job_ = std::string("/v1/jobs/") + kJobId;
  const std::string trial_ = std::string("/v1/trials/") + kTrialId;
};

}  // namespace gaitmill::api

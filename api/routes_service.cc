// What operators and clients ask of the service itself.

#include "api/dto/object_reader.h"
#include "api/errors.h"
#include "api/openapi.h"
#include "api/route_tools.h"
#include "api/routes.h"

namespace gaitmill::api {

namespace {

HttpReply findReadiness(StatusPort& status, HttpRequest&) {
  const std::string reason = status.findUnreadiness();
  require(reason.empty(), ErrorCode::kServiceUnready, reason, {"", 0, 0, "service"});
  return replyJson(200, R"({"ready":true})");
}

HttpReply findMetrics(StatusPort& status, HttpRequest&) {
  HttpReply reply = replyJson(200, status.renderMetrics());
  reply.content_type = "text/plain; version=0.0.4; charset=utf-8";
  return reply;
}

}  // namespace

Routes makeServiceRoutes(const Ports& ports, const std::string& version) {
  const std::string version_json = R"({"name":"gaitmill","version":")" + version + "\"}";
  const HttpReply document = replyTagged(openApiDocument());
  StatusPort& status = ports.status;
  // Probes of load balancers add parameters of their own, so these two ignore what they do not
  // know.
  const Handler live = [](HttpRequest&) {
    return replyJson(200, R"({"live":true})");
  };
  const Handler ready = [&status](HttpRequest& request) {
    return findReadiness(status, request);
  };
  const Handler describe = [document](HttpRequest&) {
    return document;
  };
  const Handler tell_version = [version_json](HttpRequest&) {
    return replyTagged(version_json);
  };
  const Handler explain = [](HttpRequest& request) {
    return replyTagged(renderProblemType(request.captures.at("code")));
  };
  return {
      {"GET", "/livez", BodyKind::kNone, live},
      {"GET", "/readyz", BodyKind::kNone, ready},
      {"GET", "/metrics", BodyKind::kNone, on(status, findMetrics), Scope::kRead},
      {"GET", "/openapi.json", BodyKind::kNone, withQuery({}, describe)},
      {"GET", "/problems/{code}", BodyKind::kNone, withQuery({}, explain)},
      {"GET", "/v1/version", BodyKind::kNone, withQuery({}, tell_version)},
  };
}

}  // namespace gaitmill::api

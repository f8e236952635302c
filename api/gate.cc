#include "api/gate.h"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "api/errors.h"
#include "api/multipart.h"
#include "core/base/error.h"

namespace gaitmill::api {

namespace {

constexpr std::string_view kJsonType = "application/json";
constexpr std::string_view kMultipartType = "multipart/form-data";

Where atHeader(const std::string& name) {
  Where where;
  where.field = name;
  return where;
}

std::string routedMethod(const RequestHead& head) {
  return head.method == "HEAD" ? "GET" : head.method;
}

bool hasScope(const Identity& identity, Scope scope) {
  switch (scope) {
    case Scope::kNone:
      return true;
    case Scope::kRead:
      return identity.may_read;
    case Scope::kWrite:
      return identity.may_write;
    case Scope::kAdmin:
      return identity.may_administer;
  }
  return false;
}

const char* nameOf(Scope scope) {
  return scope == Scope::kRead ? "read" : scope == Scope::kWrite ? "write" : "admin";
}

const char* describeBody(BodyKind kind) {
  switch (kind) {
    case BodyKind::kJson:
      return "application/json";
    case BodyKind::kMultipart:
      return "multipart/form-data";
    case BodyKind::kMultipartOrJson:
      return "multipart/form-data or application/json";
    case BodyKind::kNone:
    case BodyKind::kBytes:
      break;
  }
  return "of any type";
}

bool takesMultipart(BodyKind kind) {
  return kind == BodyKind::kMultipart || kind == BodyKind::kMultipartOrJson;
}

bool takesType(BodyKind kind, const std::string& type) {
  const bool takes_json = kind == BodyKind::kJson || kind == BodyKind::kMultipartOrJson;
  return kind == BodyKind::kNone || kind == BodyKind::kBytes || (takes_json && type == kJsonType) ||
         (takesMultipart(kind) && type == kMultipartType);
}

// How long the body is must be said once and by its number of bytes, and they must be its own:
// chunks hide the length, an encoding hides the content.
void checkFraming(const RequestHead& head) {
  require(!head.has("transfer-encoding"),
          ErrorCode::kRequestLengthRequired,
          "send the body with Content-Length; Transfer-Encoding is not taken",
          atHeader("Transfer-Encoding"));
  const std::string& encoding = head.header("content-encoding");
  require(encoding.empty() || toLower(encoding) == "identity",
          ErrorCode::kRequestMediaType,
          "the body must come without Content-Encoding",
          atHeader("Content-Encoding"));
  const std::string& expectation = head.header("expect");
  require(expectation.empty() || toLower(expectation) == "100-continue",
          ErrorCode::kRequestMalformed,
          "100-continue is all that may be expected",
          atHeader("Expect"));
}

}  // namespace

Admission Gate::admit(const RequestHead& head) const {
  Admission admission;
  admission.match = router_.find(routedMethod(head), head.path);
  require(!admission.match.methods.empty(),
          ErrorCode::kRequestNotFound,
          "there is nothing at this path",
          atHeader("path"));
  require(admission.match.route != nullptr,
          ErrorCode::kRequestMethod,
          "this path takes " + listMethods(head.path),
          atHeader("method"));
  admission.identity = identify(head, admission.match.route->scope);
  checkBody(head, admission);
  return admission;
}

Identity Gate::identify(const RequestHead& head, Scope scope) const {
  if (!options_.authenticate || scope == Scope::kNone) {
    return {};
  }
  const std::string& authorization = head.header("authorization");
  // Asked without a header too: a service without keys answers that it is the local caller.
  const std::optional<Identity> identity = options_.authenticate(authorization);
  require(identity.has_value(),
          ErrorCode::kUnauthorized,
          authorization.empty() ? "this needs an API key: Authorization: Bearer KEY"
                                : "the API key is not valid",
          atHeader("Authorization"));
  require(hasScope(*identity, scope),
          ErrorCode::kForbidden,
          std::string("the API key lacks the scope ") + nameOf(scope),
          atHeader("Authorization"));
  return *identity;
}

void Gate::checkBody(const RequestHead& head, Admission& admission) const {
  const Route& route = *admission.match.route;
  checkFraming(head);
  const std::string type = findMediaType(head.header("content-type"));
  require(takesType(route.body, type),
          ErrorCode::kRequestMediaType,
          std::string("the body must be ") + describeBody(route.body),
          atHeader("Content-Type"));
  require(head.content_length.has_value() || route.body == BodyKind::kNone,
          ErrorCode::kRequestLengthRequired,
          "the body is missing or has no Content-Length",
          atHeader("Content-Length"));
  const bool is_multipart = type == kMultipartType && takesMultipart(route.body);
  const std::uint64_t limit = findLimit(route, is_multipart);
  admission.body_bytes = head.content_length.value_or(0);
  require(admission.body_bytes <= limit,
          ErrorCode::kRequestTooLarge,
          "the body has " + std::to_string(admission.body_bytes) + " bytes, " +
              std::to_string(limit) + " are allowed",
          atHeader("Content-Length"));
  if (is_multipart) {
    admission.boundary = findMultipartBoundary(head.header("content-type"));
  }
}

std::uint64_t Gate::findLimit(const Route& route, bool is_multipart) const {
  const bool is_upload = is_multipart || route.body == BodyKind::kBytes;
  const std::uint64_t general = is_upload ? options_.max_upload_bytes : options_.max_json_bytes;
  return route.max_bytes > 0 ? route.max_bytes : general;
}

std::string Gate::listMethods(const std::string& path) const {
  std::vector<std::string> methods = router_.find("", path).methods;
  if (std::find(methods.begin(), methods.end(), "GET") != methods.end()) {
    methods.emplace_back("HEAD");
  }
  methods.emplace_back("OPTIONS");
  std::string list;
  for (const std::string& method : methods) {
    list += (list.empty() ? "" : ", ") + method;
  }
  return list;
}

HttpReply Gate::refuse(const Error& error,
                       const RequestHead& head,
                       const std::string& request_id) const {
  HttpReply reply = replyError(error, request_id);
  if (reply.status == 405) {
    reply.headers["Allow"] = listMethods(head.path);
  }
  return reply;
}

HttpReply Gate::describe(const RequestHead& head) const {
  const bool is_known = head.path == "*" || !router_.find("", head.path).methods.empty();
  require(is_known, ErrorCode::kRequestNotFound, "there is nothing at this path", atHeader("path"));
  HttpReply reply;
  reply.status = 204;
  reply.headers["Allow"] =
      head.path == "*" ? "GET, HEAD, POST, PUT, DELETE, OPTIONS" : listMethods(head.path);
  return reply;
}

}  // namespace gaitmill::api

#include "api/gate.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "api/errors.h"
#include "api/multipart.h"
#include "core/base/error.h"

namespace gaitmill::api {

namespace {

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

bool takesType(BodyKind kind, const std::string& type) {
  const bool is_json = type == "application/json";
  const bool is_multipart = type == "multipart/form-data";
  switch (kind) {
    case BodyKind::kJson:
      return is_json;
    case BodyKind::kMultipart:
      return is_multipart;
    case BodyKind::kMultipartOrJson:
      return is_json || is_multipart;
    case BodyKind::kNone:
    case BodyKind::kBytes:
      break;
  }
  return true;
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
  const std::string type = findMediaType(head.header("content-type"));
  require(takesType(route.body, type),
          ErrorCode::kRequestMediaType,
          std::string("the body must be ") + describeBody(route.body),
          atHeader("Content-Type"));
  require(head.content_length.has_value() || route.body == BodyKind::kNone,
          ErrorCode::kRequestLengthRequired,
          "the body is missing or has no Content-Length",
          atHeader("Content-Length"));
  const bool is_upload = route.body == BodyKind::kBytes || type == "multipart/form-data";
  const std::uint64_t general = is_upload && route.body != BodyKind::kNone
                                    ? options_.max_upload_bytes
                                    : options_.max_json_bytes;
  const std::uint64_t limit = route.max_bytes > 0 ? route.max_bytes : general;
  admission.body_bytes = head.content_length.value_or(0);
  require(admission.body_bytes <= limit,
          ErrorCode::kRequestTooLarge,
          "the body has " + std::to_string(admission.body_bytes) + " bytes, " +
              std::to_string(limit) + " are allowed",
          atHeader("Content-Length"));
  if (type == "multipart/form-data" && route.body != BodyKind::kBytes &&
      route.body != BodyKind::kNone) {
    admission.boundary = findMultipartBoundary(head.header("content-type"));
  }
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

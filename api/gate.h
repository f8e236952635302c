#pragma once

#include <cstdint>
#include <string>

#include "api/identity.h"
#include "api/request_head.h"
#include "api/router.h"
#include "api/server.h"
#include "core/base/error.h"

namespace gaitmill::api {

/// A request that may send its body.
struct Admission {
  RouteMatch match;
  Identity identity;
  std::uint64_t body_bytes = 0;
  std::string boundary;  ///< of a multipart body, else empty
};

/// Refuses what can be refused from the head alone, before a byte of body is read: unknown path or
/// method, missing key or scope, chunked or encoded bodies, media type, length.
class Gate {
 public:
  Gate(const Router& router, const ServerOptions& options) : router_(router), options_(options) {}

  /// @throws Error with the code of the refusal
  Admission admit(const RequestHead& head) const;
  /// The reply to a refusal, with the headers that its status asks for.
  HttpReply refuse(const Error& error,
                   const RequestHead& head,
                   const std::string& request_id) const;
  /// The reply to OPTIONS.
  HttpReply describe(const RequestHead& head) const;

 private:
  Identity identify(const RequestHead& head, Scope scope) const;
  void checkBody(const RequestHead& head, Admission& admission) const;
  std::uint64_t findLimit(const Route& route, bool is_multipart) const;
  std::string listMethods(const std::string& path) const;

  const Router& router_;
  const ServerOptions& options_;
};

}  // namespace gaitmill::api

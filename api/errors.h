#pragma once

#include <string>

#include "api/http.h"
#include "core/base/error.h"

namespace gaitmill::api {

/// The HTTP status of each error. A new code does not compile until it has one.
int httpStatus(ErrorCode code);

/// A few words for all errors of a kind: "Trial not found".
std::string problemTitle(ErrorCode code);

/// The problem details of an error (RFC 9457): {"type": "/problems/CODE", "title", "status",
/// "detail", "instance", "code", "where", "fix", "context"}. `where` has at least one member. For
/// faults of our own the detail is a fixed sentence: the message is for the log. A model that
/// cannot be simulated adds "unsupported": an array of {"line", "element", "reason"}.
/// @param request_id  "req_…", which becomes the instance; empty leaves that out
std::string renderProblem(const Error& error, const std::string& request_id);

/// The same without an instance: how the error of a failed job is kept and shown.
std::string renderProblemObject(const Error& error);

/// The reply for an error: its status, its problem details, and the headers that belong to the
/// status (WWW-Authenticate, Retry-After).
HttpReply replyError(const Error& error, const std::string& request_id = "");

/// Title, status and fix of a problem type: what its address answers.
/// @throws Error kRequestNotFound if no error has this code
std::string renderProblemType(const std::string& code);

}  // namespace gaitmill::api

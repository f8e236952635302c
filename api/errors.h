#pragma once

#include "api/http.h"
#include "core/base/error.h"

namespace gaitmill::api {

/// The HTTP status of each error. A new code does not compile until it has one.
int httpStatus(ErrorCode code);

/// The reply for an error: its status and the body of dto/error_body.h.
HttpReply replyError(const Error& error);

}  // namespace gaitmill::api

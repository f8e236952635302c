#pragma once

#include <string>

#include "core/base/error.h"

namespace gaitmill::api {

/// {"error": {"code", "message", "where": {"file", "line", "column", "field"}, "context": […]}};
/// unknown parts of `where` are left out. For faults of our own the message is a fixed sentence:
/// the details are for the log.
std::string renderError(const Error& error);

/// The object under "error" alone, as it is kept with a failed job.
std::string renderErrorObject(const Error& error);

}  // namespace gaitmill::api

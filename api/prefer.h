#pragma once

#include <chrono>
#include <optional>

#include "api/ports.h"
#include "api/route_tools.h"

namespace gaitmill::api {

/// The preference "wait" of the header Prefer (RFC 7240), at most 300 s; nullopt if there is none
/// that can be understood: preferences are never refused.
std::optional<std::chrono::seconds> findWait(const HttpRequest& request);

/// Says which wait was honoured, as Preference-Applied.
void noteWait(std::chrono::seconds wait, HttpReply& reply);

/// A reply that waits for the topic.
HttpReply parkFor(const Topic& topic, std::chrono::seconds wait);

/// A handler whose 202 to a new job is held back, as long as the header Prefer asks for, until the
/// job is final; the answer then shows the job as it stands.
Handler withWait(JobPort& jobs, Handler submit);

}  // namespace gaitmill::api

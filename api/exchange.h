#pragma once

#include <optional>
#include <string>

#include "api/http.h"
#include "api/multipart.h"
#include "api/response.h"
#include "api/router.h"
#include "api/server.h"

namespace gaitmill::api {

/// A request between the reactor, which has read it, and the handler thread that answers it. One of
/// the two has it at a time.
struct Exchange {
  const Route* route = nullptr;
  HttpRequest request;
  ReplyConditions conditions;
  std::string boundary;  ///< of multipart parts yet to be found
  MultipartLimits multipart;
  std::optional<EventFeed> events;  ///< once the answer is a stream of them
};

/// Finds the parts of the body, calls the route, and turns what it replies or throws into a
/// response. On a handler thread; never throws an Error.
Response answerExchange(Exchange& exchange, const ServerLog& log);

}  // namespace gaitmill::api

#include "api/exchange.h"

#include <utility>

#include "api/errors.h"
#include "core/base/error.h"

namespace gaitmill::api {

namespace {

void logFault(const Exchange& exchange, const ServerLog& log, const char* what) {
  log(LogLevel::kError,
      exchange.request.id + " " + exchange.request.method + " " + exchange.request.path + ": " +
          what);
}

HttpReply replyFault(const Exchange& exchange, const ServerLog& log, const Error& error) {
  HttpReply reply = replyError(error, exchange.request.id);
  if (reply.status == 500) {
    logFault(exchange, log, error.what());
  }
  return reply;
}

HttpReply callRoute(Exchange& exchange, const ServerLog& log) {
  try {
    if (!exchange.boundary.empty()) {
      exchange.request.parts = scanMultipart(
          exchange.request.body, std::exchange(exchange.boundary, ""), exchange.multipart);
    }
    return exchange.route->handle(exchange.request);
  } catch (const Error& error) {
    return replyFault(exchange, log, error);
  } catch (const std::exception& error) {
    return replyFault(exchange, log, Error(ErrorCode::kInternal, error.what()));
  }
}

Response prepareAnswer(Exchange& exchange, const ServerLog& log) {
  HttpReply reply = callRoute(exchange, log);
  try {
    return prepareResponse(std::move(reply), exchange.conditions);
  } catch (const Error& error) {
    return prepareResponse(replyFault(exchange, log, error), exchange.conditions);
  } catch (const std::exception& error) {
    const Error fault(ErrorCode::kInternal, error.what());
    return prepareResponse(replyFault(exchange, log, fault), exchange.conditions);
  }
}

}  // namespace

Response answerExchange(Exchange& exchange, const ServerLog& log) {
  Response response = prepareAnswer(exchange, log);
  if (!response.park) {
    // The end of a spooled body waits for the disk, which the reactor must not.
    exchange.request.parts.clear();
    exchange.request.body = makeByteSource("");
  }
  return response;
}

}  // namespace gaitmill::api

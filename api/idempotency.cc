#include "api/idempotency.h"

#include <algorithm>
#include <string>
#include <utility>

#include "api/digest.h"
#include "api/errors.h"

namespace gaitmill::api {

namespace {

constexpr std::size_t kMaxKeyLength = 255;

const std::string& readKey(const HttpRequest& request) {
  const std::string& key = request.header("idempotency-key");
  const bool is_printable = std::all_of(
      key.begin(), key.end(), [](char letter) { return letter > ' ' && letter < 0x7f; });
  require(key.size() <= kMaxKeyLength && is_printable,
          ErrorCode::kRequestField,
          "the key must have 1 to 255 printable characters without spaces",
          {"", 0, 0, "Idempotency-Key"});
  return key;
}

HttpReply replay(const KeptAnswer& kept, const std::string& request_hash) {
  require(kept.request_hash == request_hash,
          ErrorCode::kIdempotencyMismatch,
          "the first request with this key was another one",
          {"", 0, 0, "Idempotency-Key"});
  require(kept.status != 0,
          ErrorCode::kIdempotencyBusy,
          "the first request with this key is still being answered",
          {"", 0, 0, "Idempotency-Key"});
  HttpReply reply;
  reply.status = kept.status;
  reply.content_type = kept.content_type;
  reply.body = kept.body;
  reply.headers["Idempotency-Replayed"] = "true";
  if (!kept.location.empty()) {
    reply.headers["Location"] = kept.location;
  }
  return reply;
}

KeptAnswer keep(const HttpReply& reply, const std::string& request_hash) {
  const auto location = reply.headers.find("Location");
  return {request_hash,
          reply.status,
          reply.content_type,
          location == reply.headers.end() ? "" : location->second,
          reply.body};
}

// Errors are answers here, so that they can be kept; except for our own faults, because whoever
// logs those has to see the message.
HttpReply answerOrAbandon(IdempotencyPort& port,
                          const std::string& key,
                          const Handler& handler,
                          HttpRequest& request) {
  try {
    return handler(request);
  } catch (const Error& error) {
    if (httpStatus(error.code()) < 500) {
      return replyError(error, request.id);
    }
    port.abandon(request.identity, key);
    throw;
  } catch (...) {
    port.abandon(request.identity, key);
    throw;
  }
}

}  // namespace

Handler withIdempotency(IdempotencyPort& port, Handler handler) {
  return [&port, handler = std::move(handler)](HttpRequest& request) {
    const std::string key = readKey(request);
    if (key.empty()) {
      return handler(request);
    }
    const std::string request_hash = hashRequest(request);
    if (const auto kept = port.begin(request.identity, key, request_hash)) {
      return replay(*kept, request_hash);
    }
    // A fault in finish() leaves the key taken: better refused for a day than done twice.
    HttpReply reply = answerOrAbandon(port, key, handler, request);
    if (reply.status == 429) {
      port.abandon(request.identity, key);
    } else {
      port.finish(request.identity, key, keep(reply, request_hash));
    }
    return reply;
  };
}

}  // namespace gaitmill::api

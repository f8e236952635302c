// API keys, for administrators.

#include "api/digest.h"
#include "api/dto/catalog.h"
#include "api/route_tools.h"
#include "api/routes.h"

namespace gaitmill::api {

namespace {

// Without Idempotency-Key: a kept answer would keep the secret, which nobody may read again.
HttpReply addKey(KeyPort& keys, HttpRequest& request) {
  require(request.header("idempotency-key").empty(),
          ErrorCode::kRequestField,
          "an answer with a secret is never kept, so keys cannot be made with an Idempotency-Key",
          {"", 0, 0, "Idempotency-Key"});
  checkContentDigest(request);
  const KeyRequest wanted = parseKeyRequest(bodyText(request));
  HttpReply reply =
      replyJson(201, renderKey(keys.add(request.identity, wanted.name, wanted.scopes)));
  reply.headers["Cache-Control"] = "no-store";
  return reply;
}

HttpReply listKeys(KeyPort& keys, HttpRequest& request) {
  return replyPage(Page<KeyView>{keys.list(request.identity), ""}, renderKey);
}

HttpReply revokeKey(KeyPort& keys, HttpRequest& request) {
  keys.revoke(request.identity, idOf(request, "key_", ErrorCode::kKeyNotFound));
  return replyNothing();
}

}  // namespace

Routes makeKeyRoutes(const Ports& ports) {
  KeyPort& keys = ports.keys;
  return {
      {"POST", "/v1/keys", BodyKind::kJson, on(keys, addKey), Scope::kAdmin},
      {"GET", "/v1/keys", BodyKind::kNone, on(keys, listKeys), Scope::kAdmin},
      {"DELETE", "/v1/keys/{id}", BodyKind::kNone, on(keys, revokeKey), Scope::kAdmin},
  };
}

}  // namespace gaitmill::api

#include "service/idempotency_service.h"

namespace gaitmill {

namespace {

std::string makeOwnKey(const api::Identity& who, const std::string& key) {
  return who.key_id + ":" + key;
}

}  // namespace

std::optional<api::KeptAnswer> IdempotencyService::begin(const api::Identity& who,
                                                         const std::string& key,
                                                         const std::string& request_hash) {
  return store_.begin(who.tenant, makeOwnKey(who, key), request_hash);
}

void IdempotencyService::finish(const api::Identity& who,
                                const std::string& key,
                                const api::KeptAnswer& answer) {
  store_.finish(who.tenant, makeOwnKey(who, key), answer);
}

void IdempotencyService::abandon(const api::Identity& who, const std::string& key) {
  store_.abandon(who.tenant, makeOwnKey(who, key));
}

}  // namespace gaitmill

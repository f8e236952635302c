#include "service/key_cache.h"

#include <algorithm>
#include <utility>

#include "core/base/error.h"
#include "service/api_key.h"
#include "service/observe/log.h"
#include "service/storage/sha256.h"

namespace gaitmill {

namespace {

api::Identity makeIdentity(const api::KeyView& key) {
  const auto has = [&key](const char* scope) {
    return std::find(key.scopes.begin(), key.scopes.end(), scope) != key.scopes.end();
  };
  return {key.tenant, key.id, has("read"), has("write"), has("admin")};
}

}  // namespace

KeyCache::KeyCache(KeyLookup lookup, KeyPolicy policy, std::chrono::milliseconds max_age)
    : lookup_(std::move(lookup)), policy_(policy), max_age_(max_age) {}

std::optional<api::Identity> KeyCache::authenticate(const std::string& authorization_header) {
  const std::lock_guard<std::mutex> lock(guard_);
  try {
    refresh();
    // Revoked keys count: taking the last one back must not open the service to everyone.
    if (version_ == 0 && policy_ == KeyPolicy::kOpenWithoutKeys) {
      return api::Identity{};
    }
    const std::optional<PresentedKey> presented = parseAuthorization(authorization_header);
    return presented ? identify(presented->id, presented->secret) : std::nullopt;
  } catch (const Error& error) {
    logEvent(Severity::kError, "keys.unreadable", {{"message", error.what()}});
    return std::nullopt;
  }
}

void KeyCache::expire() {
  const std::lock_guard<std::mutex> lock(guard_);
  expired_ = true;
}

void KeyCache::refresh() {
  const auto now = std::chrono::steady_clock::now();
  if (!expired_ && now - asked_ < max_age_) {
    return;
  }
  asked_ = now;
  try {
    const std::int64_t version = lookup_.version();
    if (version != version_) {
      known_.clear();
      version_ = version;
    }
    expired_ = false;
  } catch (const Error& error) {
    logEvent(Severity::kError, "keys.unreadable", {{"message", error.what()}});
  }
}

std::optional<api::Identity> KeyCache::identify(const std::string& key_id,
                                                const std::string& secret) {
  const auto known = known_.find(key_id);
  if (known != known_.end()) {
    return matchesSecret(secret, known->second.secret_sha256)
               ? std::optional<api::Identity>(known->second.identity)
               : std::nullopt;
  }
  const std::string hash = calcSha256(secret);
  const std::optional<api::KeyView> found = lookup_.find(hash);
  if (!found || found->id != key_id) {
    return std::nullopt;
  }
  return known_.emplace(key_id, KnownKey{hash, makeIdentity(*found)}).first->second.identity;
}

}  // namespace gaitmill

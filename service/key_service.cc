#include "service/key_service.h"

#include <algorithm>

#include "core/base/error.h"
#include "service/api_key.h"

namespace gaitmill {

namespace {

const std::vector<std::string>& scopeNames() {
  static const std::vector<std::string> names = {"read", "write", "admin"};
  return names;
}

void requireScopes(const std::vector<std::string>& scopes) {
  require(!scopes.empty(),
          ErrorCode::kRequestField,
          "a key needs at least one scope of read, write, admin",
          {"", 0, 0, "scopes"});
  for (const std::string& scope : scopes) {
    require(std::count(scopeNames().begin(), scopeNames().end(), scope) == 1,
            ErrorCode::kRequestField,
            "'" + scope + "' is none of the scopes read, write, admin",
            {"", 0, 0, "scopes"});
  }
}

// Each scope once, in the order of scopeNames().
std::vector<std::string> sortScopes(const std::vector<std::string>& scopes) {
  std::vector<std::string> sorted;
  for (const std::string& scope : scopeNames()) {
    if (std::find(scopes.begin(), scopes.end(), scope) != scopes.end()) {
      sorted.push_back(scope);
    }
  }
  return sorted;
}

}  // namespace

api::KeyView KeyService::add(const api::Identity& who,
                             const std::string& name,
                             const std::vector<std::string>& scopes) {
  requireScopes(scopes);
  const NewSecret secret = makeSecret();
  api::KeyView key;
  key.tenant = who.tenant;
  key.name = name;
  key.scopes = sortScopes(scopes);
  key = store_.add(key, secret.sha256);
  key.secret = makeToken(key.id, secret.letters);
  expire();
  return key;
}

std::vector<api::KeyView> KeyService::list(const api::Identity& who) {
  return store_.list(who.tenant);
}

void KeyService::revoke(const api::Identity& who, const std::string& key_id) {
  store_.revoke(who.tenant, key_id);
  expire();
}

void KeyService::expire() {
  if (cache_ != nullptr) {
    cache_->expire();
  }
}

KeyLookup makeKeyLookup(KeyStore& store) {
  return {[&store](const std::string& hash) { return store.findBySecretHash(hash); },
          [&store] {
            return store.version();
          }};
}

}  // namespace gaitmill

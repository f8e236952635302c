#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "api/dto/catalog.h"
#include "api/identity.h"

namespace gaitmill {

/// Where keys are looked up: KeyStore, or a test.
struct KeyLookup {
  /// A key in force by the hash of its secret.
  std::function<std::optional<api::KeyView>(const std::string& secret_sha256)> find;
  /// Grows with every key that is added or revoked by any process; 0 = there has never been one.
  std::function<std::int64_t()> version;
};

/// Whether a service that has never had a key serves everyone as the local tenant (it then listens
/// on loopback only), or nobody.
enum class KeyPolicy { kOpenWithoutKeys, kKeysRequired };

/// Whom a request speaks for, from memory: one hash and no query for a key that was used before.
/// Every `max_age` one small query asks whether keys have changed; that bounds how long a key works
/// that another process has revoked. Safe from any thread.
class KeyCache {
 public:
  static constexpr std::chrono::milliseconds kMaxAge{250};

  KeyCache(KeyLookup lookup, KeyPolicy policy, std::chrono::milliseconds max_age = kMaxAge);

  /// An api::Authenticator. A storage that cannot be read leaves the known keys as they were.
  std::optional<api::Identity> authenticate(const std::string& authorization_header);
  /// The keys have changed: what is known is asked again at the next request.
  void expire();

 private:
  struct KnownKey {
    std::string secret_sha256;
    api::Identity identity;
  };

  void refresh();
  std::optional<api::Identity> identify(const std::string& key_id, const std::string& secret);

  KeyLookup lookup_;
  KeyPolicy policy_;
  std::chrono::milliseconds max_age_;
  std::mutex guard_;
  std::optional<std::int64_t> version_;  ///< of the known keys; nothing before the first answer
  std::map<std::string, KnownKey> known_;
  std::chrono::steady_clock::time_point asked_;
  bool expired_ = true;
};

}  // namespace gaitmill

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "api/dto/catalog.h"
#include "service/storage/database.h"
#include "service/storage/usage.h"

namespace gaitmill {

/// API keys. The secret itself is never stored, only its SHA-256: a random secret of 256 bits
/// needs no slower hash.
class KeyStore {
 public:
  explicit KeyStore(Database& database) : database_(database) {}

  /// @param key  its id and time are filled in by the store, its secret is not looked at
  api::KeyView add(const api::KeyView& key, const std::string& secret_sha256);
  /// A key in force with this hash; compare the hash again in constant time.
  std::optional<api::KeyView> findBySecretHash(const std::string& secret_sha256);
  /// Of one tenant, revoked ones too, newest first; of all tenants if `tenant` is empty.
  std::vector<api::KeyView> list(const std::string& tenant);
  /// @throws Error kKeyNotFound, also for one of another tenant unless `tenant` is empty
  void revoke(const std::string& tenant, const std::string& key_id);
  /// Whether any key is in force.
  bool hasKeys();
  /// Grows with every add and revoke by any process: whoever keeps keys in memory asks it.
  std::int64_t version();

  /// @param key_id  empty for what local callers of the tenant have stored
  Usage findUsage(const std::string& tenant, const std::string& key_id);

 private:
  Database& database_;
};

}  // namespace gaitmill

#pragma once

#include <string>
#include <vector>

#include "api/ports.h"
#include "service/key_cache.h"
#include "service/storage/key_store.h"

namespace gaitmill {

/// API keys behind the API and the command line. An administrator sees and makes the keys of the
/// own tenant.
class KeyService : public api::KeyPort {
 public:
  /// @param cache  told of every change; may be null
  KeyService(KeyStore& store, KeyCache* cache) : store_(store), cache_(cache) {}

  /// @throws Error kRequestField for a scope that does not exist, or none
  api::KeyView add(const api::Identity& who,
                   const std::string& name,
                   const std::vector<std::string>& scopes) override;
  std::vector<api::KeyView> list(const api::Identity& who) override;
  void revoke(const api::Identity& who, const std::string& key_id) override;

 private:
  void expire();

  KeyStore& store_;
  KeyCache* cache_;
};

/// How a KeyCache asks a store.
KeyLookup makeKeyLookup(KeyStore& store);

}  // namespace gaitmill

#pragma once

#include <optional>
#include <string>

#include "api/ports.h"
#include "service/storage/idempotency_store.h"

namespace gaitmill {

/// Idempotency keys behind the API, each API key's own: two clients of one tenant may use the same
/// word.
class IdempotencyService : public api::IdempotencyPort {
 public:
  explicit IdempotencyService(IdempotencyStore& store) : store_(store) {}

  std::optional<api::KeptAnswer> begin(const api::Identity& who,
                                       const std::string& key,
                                       const std::string& request_hash) override;
  void finish(const api::Identity& who,
              const std::string& key,
              const api::KeptAnswer& answer) override;
  void abandon(const api::Identity& who, const std::string& key) override;

 private:
  IdempotencyStore& store_;
};

}  // namespace gaitmill

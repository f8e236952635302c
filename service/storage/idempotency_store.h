#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "api/ports.h"
#include "service/storage/database.h"

namespace gaitmill {

/// First answers to requests with an Idempotency-Key, kept for a day.
class IdempotencyStore {
 public:
  static constexpr std::int64_t kKeptMilliseconds = 24 * 3'600 * 1'000;

  /// @param owner  of this process: a request that an earlier process began and never answered may
  ///               be begun again
  IdempotencyStore(Database& database, std::string owner)
      : database_(database), owner_(std::move(owner)) {}

  /// Claims the key for this request, or returns what is there: the kept answer, or one with
  /// status 0 while another request of this process is being answered, or where an earlier process
  /// began another request under this key and never answered it.
  std::optional<api::KeptAnswer> begin(const std::string& tenant,
                                       const std::string& key,
                                       const std::string& request_hash);
  void finish(const std::string& tenant, const std::string& key, const api::KeptAnswer& answer);
  void abandon(const std::string& tenant, const std::string& key);
  /// Forgets answers older than a day, and which key stored what before that. @returns how many
  /// answers
  int removeExpired();

 private:
  Database& database_;
  std::string owner_;
};

}  // namespace gaitmill

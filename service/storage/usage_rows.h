#pragma once

#include <string>

#include "service/storage/connection.h"
#include "service/storage/usage.h"

namespace gaitmill {

/// Within a write: adds `change` to what the key has stored.
/// @throws Error kQuotaExceeded if that is more than the quota in something that `change` adds to
void chargeUsage(Connection& db,
                 const std::string& tenant,
                 const std::string& key_id,
                 const Usage& change,
                 const Quota& quota = {});

/// Within a write: the next value of a counter ("jobs", "keys").
std::int64_t nextCount(Connection& db, const char* counter);

}  // namespace gaitmill

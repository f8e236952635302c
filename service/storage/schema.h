#pragma once

#include <cstdint>
#include <string>

#include "service/storage/connection.h"

namespace gaitmill {

/// Number of migrations that a database has seen; 0 for an empty one.
std::int64_t findSchemaVersion(Connection& db);

/// @throws Error kStorageVersion if the database is newer than this binary
void requireKnownVersion(Connection& db, const std::string& path);

/// Brings the database to this binary's shape. One transaction per step: a crash between two of
/// them leaves a database that the next start continues from.
/// @throws Error kStorageVersion, kStorage, kStorageFull
void migrateDatabase(Connection& db, const std::string& path);

}  // namespace gaitmill

#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "service/storage/connection.h"

namespace gaitmill {

struct SqliteOptions {
  std::string path;
  std::string vfs;            ///< empty = the usual one
  std::int64_t max_size = 0;  ///< [bytes]; 0 = no limit
};

/// Opens or creates a database file with the settings of dialect.h.
/// @throws Error kStorage, kStorageFull
std::unique_ptr<Connection> openSqlite(const SqliteOptions& options);

}  // namespace gaitmill

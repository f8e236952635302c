#pragma once

#include <vector>

namespace gaitmill {

/// One step of the database's shape: migrations/<name>.sql as it was when the binary was built.
struct Migration {
  const char* name;  ///< "0002_jobs"
  const char* sql;
};

/// In order; the version of a database is the number of them it has seen.
const std::vector<Migration>& allMigrations();

}  // namespace gaitmill

#pragma once

#include <ostream>
#include <string>

namespace gaitmill {

/// `gaitmill backup FILE`: a copy of the database, in use or not.
struct BackupOptions {
  std::string database = "gaitmill.db";
  std::string file;
};

/// `gaitmill restore FILE`: a backup in the place of the database.
struct RestoreOptions {
  enum class Overwrite { kNo, kYes };
  std::string database = "gaitmill.db";
  std::string file;
  Overwrite overwrite = Overwrite::kNo;  ///< whether a database that is there may be replaced
};

/// Says on `out` what was copied. @throws Error kStorage…, kFileNotFound
void backUp(const BackupOptions& options, std::ostream& out);
void restore(const RestoreOptions& options, std::ostream& out);

}  // namespace gaitmill

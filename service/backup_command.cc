#include "service/backup_command.h"

#include <filesystem>

#include "core/base/error.h"
#include "service/storage/backup.h"

namespace gaitmill {

namespace {

void requireFile(const std::string& path) {
  std::error_code absent;
  require(std::filesystem::is_regular_file(path, absent),
          ErrorCode::kFileNotFound,
          "there is no such file",
          {path});
}

void printSize(const std::string& what, const std::string& path, std::ostream& out) {
  out << what << ' ' << path << ", " << std::filesystem::file_size(path) << " bytes\n";
}

}  // namespace

void backUp(const BackupOptions& options, std::ostream& out) {
  requireFile(options.database);
  backUpDatabase(options.database, options.file);
  printSize("backup", options.file, out);
}

void restore(const RestoreOptions& options, std::ostream& out) {
  requireFile(options.file);
  restoreDatabase(
      options.file,
      options.database,
      options.overwrite == RestoreOptions::Overwrite::kYes ? Existing::kReplace : Existing::kKeep);
  printSize("database", options.database, out);
}

}  // namespace gaitmill

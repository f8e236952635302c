#include "core/io/files.h"

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "core/base/error.h"
#include "core/io/file_content.h"

namespace gaitmill {

namespace fs = std::filesystem;

std::string readFile(const std::string& path, std::size_t maximum_size) {
  const Where where{path, 0, 0, {}};
  std::error_code status;
  require(fs::exists(path, status), ErrorCode::kFileNotFound, "there is no such file", where);
  require(fs::is_regular_file(path, status), ErrorCode::kFileUnreadable, "not a file", where);
  const std::uintmax_t size = fs::file_size(path, status);
  require(!status, ErrorCode::kFileUnreadable, "its size cannot be read", where);
  require(size <= maximum_size,
          ErrorCode::kFileTooLarge,
          "the file has " + std::to_string(size) + " bytes, at most " +
              std::to_string(maximum_size) + " can be read",
          where);
  std::ifstream file(path, std::ios::binary);
  require(file.is_open(), ErrorCode::kFileUnreadable, "the file cannot be opened", where);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  require(!file.bad(), ErrorCode::kFileUnreadable, "reading the file failed", where);
  requireData(bytes, path);
  return bytes;
}

std::vector<std::string> listFiles(const std::string& folder, std::string_view ending) {
  std::vector<std::string> paths;
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(folder, unreadable)) {
    const std::string path = entry.path().string();
    if (entry.is_regular_file() && path.size() > ending.size() &&
        path.compare(path.size() - ending.size(), ending.size(), ending) == 0) {
      paths.push_back(path);
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

void writeFile(const std::string& path, std::string_view bytes) {
  const Where where{path, 0, 0, {}};
  const fs::path target(path);
  std::error_code status;
  if (target.has_parent_path()) {
    fs::create_directories(target.parent_path(), status);
  }
  const fs::path temporary = path + "." + std::to_string(::getpid()) + ".part";
  {
    std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.flush();
    if (!file) {
      fs::remove(temporary, status);
      throw Error(ErrorCode::kFileUnwritable, "the file cannot be written", where);
    }
  }
  fs::rename(temporary, target, status);
  if (status) {
    const std::string reason = status.message();
    fs::remove(temporary, status);
    throw Error(ErrorCode::kFileUnwritable, "the file cannot be replaced: " + reason, where);
  }
}

}  // namespace gaitmill

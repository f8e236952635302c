#include "service/models_folder.h"

#include <filesystem>
#include <vector>

#include "core/base/error.h"

namespace gaitmill {

std::string findModelsFolder(const std::string& asked) {
  namespace fs = std::filesystem;
  std::error_code absent;
  const fs::path program = fs::read_symlink("/proc/self/exe", absent).parent_path();
  const std::vector<fs::path> places =
      asked.empty() ? std::vector<fs::path>{"models",
                                            program / "../../models",
                                            program / "../share/gaitmill/models"}
                    : std::vector<fs::path>{asked};
  std::string tried;
  for (const fs::path& place : places) {
    if (fs::is_directory(place, absent)) {
      return place.lexically_normal().string();
    }
    tried += (tried.empty() ? "" : ", ") + place.string();
  }
  throw Error(
      ErrorCode::kFileNotFound, "no folder of models; looked at " + tried, {"", 0, 0, "models"});
}

}  // namespace gaitmill

#include "service/settings_service.h"

#include <algorithm>
#include <utility>

#include "core/base/error.h"

namespace gaitmill {

namespace {

constexpr const char* kDefaults = "defaults";

}  // namespace

SettingsService::SettingsService(SettingsCatalog shipped, std::string default_settings)
    : shipped_(std::move(shipped)), default_settings_(std::move(default_settings)) {}

std::vector<std::string> SettingsService::listNames() {
  std::vector<std::string> names = shipped_.listNames();
  names.insert(std::lower_bound(names.begin(), names.end(), kDefaults), kDefaults);
  return names;
}

std::string SettingsService::find(const std::string& name) {
  if (name == kDefaults) {
    return default_settings_;
  }
  const std::vector<std::string> names = listNames();
  const std::string nearest = findNearestName(name, names);
  require(std::find(names.begin(), names.end(), name) != names.end(),
          ErrorCode::kSettingsNotFound,
          "there are no settings '" + name + "'" +
              (nearest.empty() ? "" : ", did you mean '" + nearest + "'?"),
          {"", 0, 0, name});
  return shipped_.find(name).bytes;
}

}  // namespace gaitmill

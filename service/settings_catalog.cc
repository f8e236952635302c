#include "service/settings_catalog.h"

#include <algorithm>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/io/files.h"

namespace gaitmill {

namespace {

using nlohmann::json;

json parseObject(const InputFile& document) {
  json object = json::parse(document.bytes, nullptr, false);
  require(object.is_object(),
          ErrorCode::kSettingsJson,
          "settings must be a JSON object",
          {document.name, 0, 0, ""});
  return object;
}

std::string joinNames(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) {
    list += (list.empty() ? "" : ", ") + name;
  }
  return list.empty() ? "none" : list;
}

}  // namespace

std::vector<std::string> SettingsCatalog::listNames() const {
  std::vector<std::string> names;
  std::error_code absent;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, absent)) {
    if (entry.path().extension() == ".json") {
      names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

// The name is looked up in the list, never pasted into a path.
InputFile SettingsCatalog::find(const std::string& name) const {
  const std::vector<std::string> names = listNames();
  require(std::find(names.begin(), names.end(), name) != names.end(),
          ErrorCode::kSettingsValue,
          "there are no settings of this name; there are: " + joinNames(names),
          {"", 0, 0, "settings"});
  const std::string file = name + ".json";
  return {file, readFile(folder_ + "/" + file)};
}

InputFile mergeSettings(const InputFile& base, const InputFile& changes) {
  const json patch = parseObject(changes);
  if (patch.empty()) {
    return base;
  }
  json merged = parseObject(base);
  merged.merge_patch(patch);
  return {base.name, merged.dump()};
}

InputFile makeMarkerSetSettings(const std::string& marker_set) {
  return {"trial", json{{"scale", {{"marker_set", marker_set}}}}.dump()};
}

InputFile makeFirstStageSettings(const std::string& stage) {
  return {"--from", json{{"stages", {{"first", stage}}}}.dump()};
}

}  // namespace gaitmill

#include "service/settings_catalog.h"

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

/// Settings have few levels; what lies deeper is replaced whole.
constexpr int kDeepestMerge = 8;

/// Unlike a JSON merge patch, null is a value here: it empties a filter or a set of residuals.
void mergeInto(json& base, const json& changes, int depth) {
  for (const auto& [name, value] : changes.items()) {
    json& mine = base[name];
    if (mine.is_object() && value.is_object() && depth < kDeepestMerge) {
      mergeInto(mine, value, depth + 1);
    } else {
      mine = value;
    }
  }
}

}  // namespace

SettingsCatalog::SettingsCatalog(const std::string& models_folder) {
  std::error_code absent;
  for (const auto& entry :
       std::filesystem::directory_iterator(models_folder + "/settings", absent)) {
    const std::filesystem::path& path = entry.path();
    if (path.extension() == ".json") {
      documents_[path.stem().string()] = {path.filename().string(), readFile(path.string())};
    }
  }
}

std::vector<std::string> SettingsCatalog::listNames() const {
  std::vector<std::string> names;
  for (const auto& [name, document] : documents_) {
    names.push_back(name);
  }
  return names;
}

InputFile SettingsCatalog::find(const std::string& name) const {
  const auto found = documents_.find(name);
  require(found != documents_.end(),
          ErrorCode::kSettingsValue,
          "there are no settings of this name; there are: " + joinNames(listNames()),
          {"", 0, 0, "settings"});
  return found->second;
}

InputFile mergeSettings(const InputFile& base, const InputFile& changes) {
  const json patch = parseObject(changes);
  if (patch.empty()) {
    return base;
  }
  json merged = parseObject(base);
  mergeInto(merged, patch, 0);
  return {base.name, merged.dump()};
}

InputFile makeMarkerSetSettings(const std::string& marker_set) {
  return {"trial", json{{"scale", {{"marker_set", marker_set}}}}.dump()};
}

InputFile makeFirstStageSettings(const std::string& stage) {
  return {"--from", json{{"stages", {{"first", stage}}}}.dump()};
}

}  // namespace gaitmill

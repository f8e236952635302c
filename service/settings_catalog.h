#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/pipeline/pipeline.h"

namespace gaitmill {

/// The settings documents that ship with the product (<models>/settings/<name>.json), read once.
class SettingsCatalog {
 public:
  explicit SettingsCatalog(const std::string& models_folder);

  /// @throws Error kSettingsValue naming the settings there are
  InputFile find(const std::string& name) const;
  /// In alphabetical order.
  std::vector<std::string> listNames() const;

 private:
  std::map<std::string, InputFile> documents_;  ///< by name
};

/// `base` with the fields of `changes` put over it, object by object; null is a value as any other.
/// Both are JSON objects. @throws Error kSettingsJson if one is not
InputFile mergeSettings(const InputFile& base, const InputFile& changes);

/// The settings document that chooses a marker set: {"scale": {"marker_set": name}}.
InputFile makeMarkerSetSettings(const std::string& marker_set);

/// The settings document that chooses the first stage: {"stages": {"first": stage}}.
InputFile makeFirstStageSettings(const std::string& stage);

}  // namespace gaitmill

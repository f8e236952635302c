#pragma once

#include <string>
#include <vector>

#include "api/ports.h"
#include "service/settings_catalog.h"

namespace gaitmill {

/// Settings documents behind the API: those that ship, and "defaults", which has every field.
class SettingsService : public api::SettingsPort {
 public:
  SettingsService(SettingsCatalog shipped, std::string default_settings);

  std::vector<std::string> listNames() override;
  std::string find(const std::string& name) override;

 private:
  SettingsCatalog shipped_;
  std::string default_settings_;
};

}  // namespace gaitmill

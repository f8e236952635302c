#include "service/settings_service.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/pipeline/pipeline.h"
#include "tests/service/expect_error.h"

namespace gaitmill {
namespace {

TEST(SettingsService, GivesShippedDocumentsAndTheOneWithEveryField) {
  SettingsService settings(SettingsCatalog("models"), Pipeline::defaultSettings());
  const std::vector<std::string> names = settings.listNames();
  EXPECT_EQ(names, (std::vector<std::string>{"default", "defaults", "paper_run", "paper_walk"}));
  for (const std::string& name : names) {
    EXPECT_TRUE(nlohmann::json::parse(settings.find(name)).is_object()) << name;
  }
  EXPECT_EQ(settings.find("defaults"), Pipeline::defaultSettings());
  EXPECT_ERROR(settings.find("../settings/default"), ErrorCode::kSettingsNotFound);
  EXPECT_ERROR(settings.find("paper"), ErrorCode::kSettingsNotFound);
}

}  // namespace
}  // namespace gaitmill

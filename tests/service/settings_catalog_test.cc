#include "service/settings_catalog.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "tests/support/temporary_folder.h"

namespace gaitmill {
namespace {

TEST(SettingsCatalog, FindsNamesAndNothingElse) {
  const TemporaryFolder folder;
  folder.write("settings/default.json", R"({"a": 1})");
  folder.write("settings/paper.json", R"({"a": 2})");
  folder.write("secret.json", "{}");
  const SettingsCatalog catalog(folder.path());
  EXPECT_EQ(catalog.listNames(), (std::vector<std::string>{"default", "paper"}));
  EXPECT_EQ(catalog.find("paper").bytes, R"({"a": 2})");
  EXPECT_EQ(catalog.find("paper").name, "paper.json");
  for (const char* name : {"", "papers", "../secret", "settings/paper", "paper.json", "."}) {
    try {
      catalog.find(name);
      ADD_FAILURE() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kSettingsValue);
      EXPECT_NE(error.message().find("default, paper"), std::string::npos);
    }
  }
}

TEST(MergeSettings, PutsChangesOverTheBase) {
  const InputFile merged = mergeSettings({"base", R"({"a": {"x": 1, "y": 2}, "b": 3})"},
                                         {"changes", R"({"a": {"y": 5}, "c": [1]})"});
  EXPECT_EQ(merged.name, "base");
  EXPECT_EQ(nlohmann::json::parse(merged.bytes),
            nlohmann::json::parse(R"({"a": {"x": 1, "y": 5}, "b": 3, "c": [1]})"));
}

// "No filter" is a setting of its own, also where the base says nothing.
TEST(MergeSettings, KeepsNull) {
  const InputFile merged = mergeSettings({"base", R"({"rra": {"cutoff": 6}})"},
                                         {"changes", R"({"rra": {"cutoff": null, "x": null}})"});
  EXPECT_EQ(nlohmann::json::parse(merged.bytes),
            nlohmann::json::parse(R"({"rra": {"cutoff": null, "x": null}})"));
}

TEST(MergeSettings, LeavesTheBaseAsItIsIfNothingChanges) {
  const std::string text = "{ \"a\" : 1 }";
  EXPECT_EQ(mergeSettings({"base", text}, {"none", "{}"}).bytes, text);
}

TEST(MergeSettings, TakesObjectsOnly) {
  EXPECT_THROW(mergeSettings({"base", "{}"}, {"changes", "[]"}), Error);
  EXPECT_THROW(mergeSettings({"base", "{"}, {"changes", R"({"a": 1})"}), Error);
}

}  // namespace
}  // namespace gaitmill

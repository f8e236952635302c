#include "service/provenance.h"

#include <functional>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace gaitmill {
namespace {

Provenance makeExample() {
  Provenance example;
  example.inputs = {{"markers", "aa"}, {"grf", "bb"}};
  example.mass = 75.3;
  example.height = 1.7;
  example.model = "cc";
  example.marker_set = "dd";
  example.settings_json = R"({"cmc": {"window_s": 0.01}, "ik": {"range": [0, 1]}})";
  example.code = "gaitmill 1";
  return example;
}

TEST(Provenance, OrderOfPartsAndFieldsIsIrrelevant) {
  Provenance other = makeExample();
  other.inputs = {{"grf", "bb"}, {"markers", "aa"}};
  other.settings_json = R"({"ik":{"range":[0,1]},"cmc":{"window_s":0.01}})";
  EXPECT_EQ(calcProvenance(other), calcProvenance(makeExample()));
}

TEST(Provenance, EveryIngredientMatters) {
  const std::vector<std::function<void(Provenance&)>> changes = {
      [](Provenance&) {},
      [](Provenance& p) { p.inputs["markers"] = "ab"; },
      [](Provenance& p) { p.inputs["emg"] = "aa"; },
      [](Provenance& p) { p.inputs.erase("grf"); },
      [](Provenance& p) { std::swap(p.inputs["grf"], p.inputs["markers"]); },
      [](Provenance& p) { p.mass = 75.300000000000011; },
      [](Provenance& p) { p.height = 1.71; },
      [](Provenance& p) { p.model = "cd"; },
      [](Provenance& p) { p.marker_set = "de"; },
      [](Provenance& p) { std::swap(p.model, p.marker_set); },
      [](Provenance& p) { p.settings_json = R"({"ik": {"range": [0, 1]}})"; },
      [](Provenance& p) { p.settings_json = R"({"cmc":{"window_s":0.01},"ik":{"range":[1,0]}})"; },
      [](Provenance& p) {
        p.code = "gaitmill 2";
      }};
  std::set<std::string> hashes;
  for (const auto& change : changes) {
    Provenance changed = makeExample();
    change(changed);
    hashes.insert(calcProvenance(changed));
  }
  EXPECT_EQ(hashes.size(), changes.size());
}

TEST(Provenance, CanonicalFormIsFixed) {
  EXPECT_EQ(renderProvenance(makeExample()),
            R"({"code":"gaitmill 1","height_m":1.7,"inputs_sha256":{"grf":"bb","markers":"aa"},)"
            R"("marker_set_sha256":"dd","mass_kg":75.3,"model_sha256":"cc",)"
            R"("settings":{"cmc":{"window_s":0.01},"ik":{"range":[0,1]}}})");
}

TEST(Provenance, CodeVersionNamesTheReleaseAndTheSources) {
  EXPECT_EQ(sourceVersion().rfind("gaitmill ", 0), 0U);
  EXPECT_EQ(sourceVersion().substr(sourceVersion().rfind(' ') + 1).size(), 16U);
}

}  // namespace
}  // namespace gaitmill

#include "api/dto/trial.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace gaitmill::api {
namespace {

TEST(ParseTrialSubject, TakesOptionsAndMarkerSet) {
  const TrialSubject subject = parseTrialSubject(
      R"({"mass_kg": 75.3, "height_m": 1.7, "marker_set": "a", "options": {"ik": {"x": 1}}})");
  EXPECT_EQ(subject.mass, 75.3);
  EXPECT_EQ(subject.height, 1.7);
  EXPECT_EQ(subject.marker_set, "a");
  EXPECT_EQ(subject.options, R"({"ik":{"x":1}})");
}

class BadSubject : public ::testing::TestWithParam<const char*> {};
TEST_P(BadSubject, IsRefusedWithItsField) {
  try {
    parseTrialSubject(GetParam());
    FAIL() << GetParam();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kRequestField);
    EXPECT_NE(error.where().field, "");
  }
}
INSTANTIATE_TEST_SUITE_P(Table,
                         BadSubject,
                         ::testing::Values(R"({})",
                                           R"([])",
                                           R"({"mass_kg": 75})",
                                           R"({"mass_kg": 750, "height_m": 1.7})",
                                           R"({"mass_kg": -75, "height_m": 1.7})",
                                           R"({"mass_kg": 75, "height_m": 170})",
                                           R"({"mass_kg": "75", "height_m": 1.7})",
                                           R"({"mass_kg": null, "height_m": 1.7})",
                                           R"({"mass_kg": 75, "height_m": 1.7, "options": []})",
                                           R"({"mass_kg": 75, "height_m": 1.7, "marker_set": 3})",
                                           R"({"mass_kg": 75, "height_m": 1.7, "colour": "red"})"));

TEST(UnderstoodFiles, SurviveStorage) {
  UnderstoodFile markers;
  markers.part = "markers";
  markers.name = "walk.trc";
  markers.size = 12345678901;
  markers.sha256 = "ab";
  markers.format = "trc";
  markers.frames = 300;
  markers.rate = 100.0;
  markers.start = 0.1;
  markers.end = 3.09;
  markers.labels_kind = "markers";
  markers.labels = {"RASI"};
  UnderstoodFile model;
  model.part = "model";
  model.format = "osim";
  const std::string json = encodeUnderstoodFiles({markers, model});
  EXPECT_EQ(encodeUnderstoodFiles(decodeUnderstoodFiles(json)), json);
  EXPECT_EQ(decodeUnderstoodFiles(json)[0].size, 12345678901);
  EXPECT_FALSE(decodeUnderstoodFiles(json)[1].frames.has_value());
}

}  // namespace
}  // namespace gaitmill::api

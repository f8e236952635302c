#include "api/dto/trial.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

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

// Trials that were stored before this was told have no marker names.
TEST(Understanding, KeepsMarkerNames) {
  TrialView trial;
  trial.marker_names =
      MarkerNamesView{"plug_in_gait",
                      0.5,
                      {{"RKNE", "RLFC", 0.98, "lateral condyle", "plug_in_gait", "", 0},
                       {"M1", "", 0, "no known set has this name", "", "RASI", 0.2}},
                      {{"left foot", 2, 1, {"LCAL", "LTOE"}}}};
  TrialView read;
  decodeUnderstanding(encodeUnderstanding(trial), read);
  ASSERT_TRUE(read.marker_names.has_value());
  EXPECT_EQ(toJson(*read.marker_names), toJson(*trial.marker_names));
  EXPECT_EQ(read.marker_names->markers[1].proposal, "RASI");
  EXPECT_EQ(read.marker_names->missing[0].any_of[1], "LTOE");
  decodeUnderstanding(R"({"files": [], "events": [], "warnings": []})", read);
  EXPECT_FALSE(read.marker_names.has_value());
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

TEST(ParseTrialSubject, NamesAreShortAndOnOneLine) {
  for (const std::string& name : {std::string(201, 'a'), std::string("two\\nlines")}) {
    EXPECT_THROW(
        parseTrialSubject(R"({"mass_kg": 75, "height_m": 1.7, "subject": ")" + name + "\"}"),
        Error);
    EXPECT_THROW(parseTrialSubject(R"({"mass_kg": 75, "height_m": 1.7, "label": ")" + name + "\"}"),
                 Error);
  }
}

TEST(Understanding, SurvivesStorage) {
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
  markers.units = "mm";
  markers.labels_kind = "markers";
  markers.labels = {"RASI"};
  markers.marker_sets = {{"lab_a", {"RASI"}, {"RTOE"}}};
  markers.recording = RecordingView{{{"plate_1", 2, ""}, {"plate_2", 11, "a treadmill"}},
                                    {"SOL"},
                                    1000.0,
                                    {{"Foot Strike", "Left", 0.5}}};
  markers.marker_faults = {{"swap", "corrected", "LTOE", "RTOE", 0.5, 0.6, 11, 0.2},
                           {"gap", "filled", "RASI", "", 0.7, 0.71, 2, std::nullopt}};
  UnderstoodFile forces;
  forces.part = "grf";
  forces.format = "table";
  forces.labels_kind = "forces";
  forces.contacts = {{"1", "left", 0.5, 1.1, true, false}, {"2", "", 0.0, 0.4, false, true}};
  TrialView trial;
  UnderstoodFile emg;
  emg.part = "emg";
  emg.format = "anc";
  emg.labels_kind = "columns";
  emg.labels = {"GAS"};
  emg.emg = EmgView{"raw", {{"GAS", "right", {"gasmed_r", "gaslat_r"}}}, {"F1X"}};
  trial.files = {markers, forces, emg};
  trial.events = {{"foot_strike", "left", 0.5}};
  trial.events[0].source = "markers";
  trial.events[0].marker_difference = -0.02;
  trial.files[1].contacts[0].confidence = 0.98;
  trial.files[1].contacts[0].flags = {"shared"};
  trial.gait = R"({"kind":"walking"})";
  trial.warnings = {"a cut last row"};
  const std::string text = encodeUnderstanding(trial);
  TrialView back;
  decodeUnderstanding(text, back);
  EXPECT_EQ(encodeUnderstanding(back), text);
  EXPECT_EQ(back.files[0].size, 12345678901);
  EXPECT_EQ(back.files[0].marker_sets[0].missing, std::vector<std::string>{"RTOE"});
  EXPECT_FALSE(back.files[1].frames.has_value());
  EXPECT_EQ(back.files[1].contacts[1].foot, "");
  EXPECT_TRUE(back.files[1].contacts[1].has_toe_off);
  EXPECT_FALSE(back.files[1].emg.has_value());
  EXPECT_EQ(back.files[2].emg->source, "raw");
  EXPECT_EQ(back.files[2].emg->channels[0].muscles.size(), 2U);
  EXPECT_EQ(back.files[2].emg->force_channels, std::vector<std::string>{"F1X"});
  EXPECT_EQ(back.events[0].time, 0.5);
  EXPECT_EQ(back.events[0].marker_difference, -0.02);
  EXPECT_EQ(back.files[1].contacts[0].flags, std::vector<std::string>{"shared"});
  EXPECT_EQ(nlohmann::json::parse(renderTrial(back))["gait"]["kind"], "walking");
  EXPECT_EQ(back.warnings, trial.warnings);
}

TEST(RenderTrial, DryRunHasNeitherIdNorTime) {
  TrialView trial;
  const auto json = nlohmann::json::parse(renderTrial(trial));
  EXPECT_EQ(json["id"], nullptr);
  EXPECT_EQ(json["created_at"], nullptr);
  trial.id = "tri_1";
  EXPECT_EQ(nlohmann::json::parse(renderTrial(trial))["created_at"], "1970-01-01T00:00:00.000Z");
}

}  // namespace
}  // namespace gaitmill::api

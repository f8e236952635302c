#include "core/pipeline/marker_set_json.h"

#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/io/files.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

MarkerSetSpec read(const std::string& bytes) {
  return readMarkerSet(InputFile{"set.json", bytes});
}

MarkerSetSpec readShipped(const std::string& name) {
  const std::string path = "models/marker_sets/" + name + ".json";
  return readMarkerSet(InputFile{path, readFile(path)});
}

/// The error of a bad document; fails if there is none.
Error findFault(const std::string& bytes) {
  try {
    read(bytes);
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "accepted: " << bytes;
  return Error(ErrorCode::kInternal, "");
}

TEST(MarkerSetJson, NameAloneIsEnough) {
  const MarkerSetSpec set = read(R"({"name": "bare"})");
  EXPECT_EQ(set.name, "bare");
  EXPECT_TRUE(set.markers.empty());
  EXPECT_TRUE(set.preserve_mass_distribution);
}

TEST(MarkerSetJson, AnglesAreConvertedAndLengthsAreNot) {
  const MarkerSetSpec set = read(R"({"name": "x", "ik": {
      "weights": {"A": 2},
      "coordinate_tasks": [{"coordinate": "knee_angle_r", "weight": 3, "value_deg": 90},
                           {"coordinate": "pelvis_ty", "weight": 1, "value_m": 0.9},
                           {"coordinate": "pelvis_tx", "weight": 1}],
      "ranges": [{"coordinate": "pelvis_rotation", "min_deg": -180, "max_deg": 180}]}})");
  ASSERT_EQ(set.ik.coordinates.size(), 3U);
  EXPECT_NEAR(*set.ik.coordinates[0].value, kPi / 2, tol(1e-15));
  EXPECT_NEAR(*set.ik.coordinates[1].value, 0.9, tol(1e-15));
  EXPECT_FALSE(set.ik.coordinates[2].value.has_value());
  EXPECT_NEAR(set.ik.ranges[0].min, -kPi, tol(1e-15));
}

TEST(MarkerSetJson, BrokenDocumentNamesLineAndColumn) {
  const Error error = findFault("{\n  \"name\": \"x\",\n  oops\n}");
  EXPECT_EQ(error.code(), ErrorCode::kSettingsJson);
  EXPECT_EQ(error.where().line, 3);
  EXPECT_EQ(error.where().column, 3);
}

TEST(MarkerSetJson, UnknownFieldNamesTheNearest) {
  const Error error = findFault(R"({"name": "x", "scale": {"mesurements": []}})");
  EXPECT_EQ(error.code(), ErrorCode::kSettingsUnknownField);
  EXPECT_EQ(error.where().field, "scale.mesurements");
  EXPECT_NE(error.message().find("'measurements'"), std::string::npos);
}

TEST(MarkerSetJson, FaultsNameThePathOfTheField) {
  struct Case {
    const char* document;
    ErrorCode code;
    const char* field;
  };
  const Case cases[] = {
      {R"({})", ErrorCode::kInputMissing, "name"},
      {R"([])", ErrorCode::kSettingsValue, ""},
      {R"({"name": 3})", ErrorCode::kSettingsValue, "name"},
      {R"({"name": "x", "markers": {}})", ErrorCode::kSettingsValue, "markers"},
      {R"({"name": "x", "markers": [{"name": "A", "body": "b", "location_m": [1, 2]}]})",
       ErrorCode::kSettingsValue,
       "markers[0].location_m"},
      {R"({"name": "x", "markers": [{"name": "A", "location_m": [1, 2, 3]}]})",
       ErrorCode::kInputMissing,
       "markers[0].body"},
      {R"({"name": "x", "scale": {"order": ["manual"]}})",
       ErrorCode::kSettingsValue,
       "scale.order"},
      {R"({"name": "x", "scale": {"time_range_s": [2, 1]}})",
       ErrorCode::kSettingsValue,
       "scale.time_range_s"},
      {R"({"name": "x", "scale": {"manual": [{"bodies": ["b"], "factors": [1, 0, 1]}]}})",
       ErrorCode::kSettingsValue,
       "scale.manual[0].factors"},
      {R"({"name": "x", "scale": {"measurements": [{"name": "m", "bodies": ["b"]}]}})",
       ErrorCode::kSettingsValue,
       "scale.measurements[0].pairs"},
      {R"({"name": "x", "scale": {"measurements":
          [{"name": "m", "bodies": ["b"], "pairs": [["A"]]}]}})",
       ErrorCode::kSettingsValue,
       "scale.measurements[0].pairs"},
      {R"({"name": "x", "scale": {"measurements":
          [{"name": "m", "bodies": ["b"], "pairs": [["A", "B"]], "axes": "XW"}]}})",
       ErrorCode::kSettingsValue,
       "scale.measurements[0].axes"},
      {R"({"name": "x", "placement": [{"weights": {"A": -1}}]})",
       ErrorCode::kSettingsValue,
       "placement[0].weights.A"},
      {R"({"name": "x", "ik": {"weights": {"A": "much"}}})",
       ErrorCode::kSettingsValue,
       "ik.weights.A"},
      {R"({"name": "x", "ik": {"ranges": [{"coordinate": "c", "min_m": 2, "max_m": 1}]}})",
       ErrorCode::kSettingsValue,
       "ik.ranges[0].coordinate"},
      {R"({"name": "x", "ik": {"coordinate_tasks":
          [{"coordinate": "c", "weight": 1, "value_m": 2, "value_deg": 1}]}})",
       ErrorCode::kSettingsValue,
       "ik.coordinate_tasks[0].value_deg"},
  };
  for (const Case& bad : cases) {
    const Error error = findFault(bad.document);
    EXPECT_EQ(error.code(), bad.code) << bad.document << "\n" << error.what();
    EXPECT_EQ(error.where().field, bad.field) << bad.document;
    EXPECT_EQ(error.where().file, "set.json");
  }
}

TEST(MarkerSetJson, ShippedSetsHaveTheirPublishedShape) {
  const MarkerSetSpec walk = readShipped("paper_walk");
  EXPECT_EQ(walk.markers.size(), 65U);
  EXPECT_EQ(walk.order, ScalingOrder::kManualThenMeasurements);
  EXPECT_EQ(walk.measurements.size(), 6U);
  EXPECT_EQ(walk.placements.size(), 2U);
  EXPECT_EQ(walk.ik.markers.size(), 39U);
  const MarkerSetSpec run = readShipped("paper_run");
  EXPECT_TRUE(run.markers.empty());
  EXPECT_EQ(run.order, ScalingOrder::kMeasurementsThenManual);
  EXPECT_EQ(run.measurements.size(), 9U);
  EXPECT_EQ(run.placements.size(), 1U);
  EXPECT_EQ(run.ik.markers.size(), 41U);
  const MarkerSetSpec general = readShipped("rajagopal2016");
  EXPECT_GE(general.measurements.size(), 9U);
}

}  // namespace
}  // namespace gaitmill

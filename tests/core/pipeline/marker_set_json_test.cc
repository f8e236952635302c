#include "core/pipeline/marker_set_json.h"

#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/io/files.h"
#include "tests/support/model_files.h"
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
      {R"({"name": "x", "markers": [{"name": "A", "body": "b", "location_m": [1, 2, 3],
          "place_deviation_m": 0}]})",
       ErrorCode::kSettingsValue,
       "markers[0].place_deviation_m"},
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
      {R"({"name": "x", "virtual_markers": [{"name": "v", "rule": "guess", "sources": ["A"]}]})",
       ErrorCode::kSettingsValue,
       "virtual_markers[0].rule"},
      {R"({"name": "x", "virtual_markers":
          [{"name": "v", "rule": "harrington_2007_left", "sources": ["A", "B"]}]})",
       ErrorCode::kSettingsValue,
       "virtual_markers[0].sources"},
      {R"({"name": "x", "scale": {"size_ratio": 0}})",
       ErrorCode::kSettingsValue,
       "scale.size_ratio"},
      {R"({"name": "x", "scale": {"measurements": [{"name": "m", "bodies": ["b"],
          "pairs": [["A", "B"]], "limit": {"measurement": "n", "min_ratio": 2, "max_ratio": 1}}]}})",
       ErrorCode::kSettingsValue,
       "scale.measurements[0].limit.max_ratio"},
      {R"({"name": "x", "placement": [{"min_visible_fraction": 1.5}]})",
       ErrorCode::kSettingsValue,
       "placement[0].min_visible_fraction"},
  };
  for (const Case& bad : cases) {
    const Error error = findFault(bad.document);
    EXPECT_EQ(error.code(), bad.code) << bad.document << "\n" << error.what();
    EXPECT_EQ(error.where().field, bad.field) << bad.document;
    EXPECT_EQ(error.where().file, "set.json");
  }
}

/// A set in which every field has a value of its own.
constexpr const char* kFullSet = R"({"name": "full", "description": "all",
  "markers": [{"name": "K", "body": "femur_r", "location_m": [0, -0.4, 0], "fixed": true,
               "place_deviation_m": 0.02}],
  "virtual_markers": [{"name": "K", "rule": "mean", "sources": ["A", "B"]},
                      {"name": "H", "rule": "harrington_2007_left", "sources": ["A", "B", "C"]}],
  "scale": {"order": ["manual", "measurements"], "time_range_s": [0.5, 1], "size_ratio": 1.07,
    "preserve_mass_distribution": false,
    "manual": [{"bodies": ["hand_r"], "factors": [1, 2, 3]}],
    "measurements": [{"name": "m", "pairs": [["A", "B"]], "bodies": ["femur_r"], "axes": "XZ",
      "required": false, "in_fitted_pose": true, "alternative_of": "g", "min_factor": 0.7,
      "max_factor": 1.4, "limit": {"measurement": "n", "min_ratio": 0.8, "max_ratio": 1.2}}]},
  "placement": [{"time_range_s": [0, 2], "min_visible_fraction": 0.5, "weights": {"A": 3},
    "coordinate_tasks": [{"coordinate": "knee_angle_r", "weight": 2, "value_deg": 5},
                         {"coordinate": "pelvis_ty", "weight": 1, "value_m": 0.9}],
    "ranges": [{"coordinate": "pelvis_rotation", "min_deg": -180, "max_deg": 180},
               {"coordinate": "pelvis_tx", "min_m": -9}]}],
  "ik": {"weights": {"B": 4}}})";

TEST(MarkerSetJson, WrittenSetReadsBackTheSame) {
  const std::string once = writeMarkerSet(read(kFullSet), readOwnModel());
  const MarkerSetSpec set = read(once);
  EXPECT_EQ(writeMarkerSet(set, readOwnModel()), once);
  EXPECT_EQ(set.virtual_markers[1].rule, VirtualMarkerSpec::Rule::kLeftHipCenter);
  EXPECT_EQ(set.virtual_markers[1].sources.size(), 3U);
  EXPECT_EQ(set.size_ratio, 1.07);
  EXPECT_EQ(set.place_deviations.at("K"), 0.02);
  const MeasurementSpec& measurement = set.measurements.at(0);
  EXPECT_TRUE(measurement.in_fitted_pose);
  EXPECT_EQ(measurement.alternative_of, "g");
  EXPECT_EQ(measurement.limit->max_ratio, 1.2);
  EXPECT_EQ(measurement.max_factor, 1.4);
  EXPECT_EQ(set.placements.at(0).min_visible_fraction, 0.5);
  EXPECT_NEAR(*set.placements[0].tasks.coordinates.at(0).value, toRadians(5), tol(1e-15));
  EXPECT_EQ(*set.placements[0].tasks.coordinates.at(1).value, 0.9);
  EXPECT_EQ(set.placements[0].tasks.ranges.at(1).min, -9);
  EXPECT_EQ(set.ik.markers.at(0).weight, 4);
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

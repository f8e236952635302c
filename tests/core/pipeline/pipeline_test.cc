// How the recipe behaves, on the embedded sample trial: same bits twice, any first stage, bad
// input.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/osim_reader.h"
#include "core/io/table_reader.h"
#include "tests/support/sample_input.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

InputFile makeSettings(const std::string& stages, const std::string& marker_set = "auto") {
  nlohmann::json settings = nlohmann::json::parse(readFile("models/settings/default.json"));
  settings["stages"] = nlohmann::json::parse(stages);
  settings["scale"]["marker_set"] = marker_set;
  return {"settings.json", settings.dump()};
}

/// One run shared by the tests that only look at it.
const PipelineResult& runWholeSample() {
  static const PipelineResult result =
      Pipeline().run(readSampleInput(), readInput("models/settings/default.json"), {});
  return result;
}

TEST(PipelineTest, LeavesEveryPromisedFile) {
  for (const char* name : {"scaled_model.osim",
                           "ik.mot",
                           "rra.mot",
                           "adjusted_model.osim",
                           "inverse_dynamics.sto",
                           "so_activations.sto",
                           "so_forces.sto",
                           "cmc_activations.sto",
                           "cmc_forces.sto",
                           "cmc_kinematics.mot",
                           "moments.csv",
                           "summary.json"}) {
    EXPECT_EQ(runWholeSample().files.count(name), 1U) << name;
  }
}

TEST(PipelineTest, SummaryHasTheStatedFigures) {
  const nlohmann::json summary = nlohmann::json::parse(runWholeSample().summary_json);
  for (const char* stage : {"scale", "ik", "id", "rra", "cmc", "so"}) {
    EXPECT_GT(summary["stages"][stage]["seconds"].get<double>(), 0) << stage;
  }
  for (const char* stage : {"ik", "so", "id"}) {
    EXPECT_GT(summary["stages"][stage]["frames"].get<int>(), 100) << stage;
  }
  // One gait cycle of 1.145 s with what is simulated before and after it.
  EXPECT_GT(summary["stages"]["cmc"]["simulated_seconds"].get<double>(), 1.2);
  for (const char* joint : {"hip_flexion_r", "knee_angle_r", "ankle_angle_r"}) {
    const nlohmann::json& moment = summary["quality"]["moments"][joint];
    for (const char* figure : {"rmse_nm",
                               "peak_difference_nm",
                               "rmse_percent_of_peak",
                               "peak_difference_percent_of_peak"}) {
      EXPECT_TRUE(moment[figure].is_number()) << joint << " " << figure;
    }
    // The paper's bounds for walking.
    EXPECT_LT(moment["rmse_percent_of_peak"].get<double>(), tol(2)) << joint;
    EXPECT_LT(moment["peak_difference_percent_of_peak"].get<double>(), tol(6)) << joint;
  }
  for (const char* stage : {"rra", "cmc"}) {
    const nlohmann::json& tracking = summary["quality"]["tracking"][stage];
    EXPECT_LT(tracking["max_rms_deg"].get<double>(), tol(1)) << stage;
    EXPECT_LT(tracking["max_deg"].get<double>(), tol(2)) << stage;
    EXPECT_LT(tracking["max_rms_cm"].get<double>(), tol(1)) << stage;
    EXPECT_LT(tracking["max_cm"].get<double>(), tol(2)) << stage;
  }
  EXPECT_GT(summary["quality"]["moments"]["fraction_of_instants_at_90_percent"].get<double>(), 0.9);
  EXPECT_EQ(summary["verdict"], "pass");
  EXPECT_TRUE(summary["quality"]["reasons"].empty());
  EXPECT_GT(summary["quality"]["checks"].size(), 15U);
}

TEST(PipelineTest, TablesHaveUnitsAndACycle) {
  for (const char* name : {"moments", "activations", "forces", "kinematics", "residuals"}) {
    const TimeSeries& table = runWholeSample().tables.at(name);
    EXPECT_EQ(table.units.size(), table.labels.size()) << name;
    EXPECT_TRUE(table.values.allFinite()) << name;
    const TimeSeries& cycle = runWholeSample().cycle_tables.at(name);
    EXPECT_EQ(cycle.rowCount(), 101) << name;
    EXPECT_EQ(cycle.time.back(), 100.0) << name;
  }
}

TEST(PipelineTest, FilesReadBack) {
  const PipelineResult& result = runWholeSample();
  const ModelSpec model = readOsim(result.files.at("scaled_model.osim"), "scaled_model.osim");
  EXPECT_NEAR(model.calcTotalMass(), 70.0, tol(1e-9));
  const TimeSeries ik = toCoordinates(readTable(result.files.at("ik.mot"), "ik.mot"), model);
  EXPECT_EQ(ik.columnCount(), 39);
  EXPECT_EQ(readTable(result.files.at("cmc_forces.sto"), "cmc_forces.sto").table.columnCount(),
            113);
}

TEST(PipelineTest, TwiceGivesTheSameBits) {
  const PipelineResult again =
      Pipeline().run(readSampleInput(), readInput("models/settings/default.json"), {});
  for (const auto& [name, bytes] : runWholeSample().files) {
    if (name != "summary.json") {  // holds processor seconds
      EXPECT_EQ(again.files.at(name), bytes) << name;
    }
  }
}

// Each stage can be started from an earlier run's files, and then gives the same numbers.
TEST(PipelineTest, StagesStartFromGivenInput) {
  const PipelineResult& whole = runWholeSample();
  TrialInput input = readSampleInput();
  input.model = InputFile{"scaled_model.osim", whole.files.at("scaled_model.osim")};
  input.coordinates = InputFile{"ik.mot", whole.files.at("ik.mot")};
  const PipelineResult from_rra =
      Pipeline().run(input, makeSettings(R"({"first": "rra", "last": "id"})"), {});
  EXPECT_EQ(from_rra.files.count("ik.mot"), 0U);
  const TimeSeries expected = readTable(whole.files.at("inverse_dynamics.sto"), "a.sto").table;
  const TimeSeries found = readTable(from_rra.files.at("inverse_dynamics.sto"), "b.sto").table;
  EXPECT_LT((expected.values - found.values).cwiseAbs().maxCoeff(),
            tol(1e-6));  // degrees and back: 1e-15 rad

  input.model = InputFile{"adjusted_model.osim", whole.files.at("adjusted_model.osim")};
  input.coordinates = InputFile{"rra.mot", whole.files.at("rra.mot")};
  const PipelineResult so =
      Pipeline().run(input, makeSettings(R"({"first": "so", "last": "so"})"), {});
  const TimeSeries a = readTable(whole.files.at("so_activations.sto"), "a.sto").table;
  const TimeSeries b = readTable(so.files.at("so_activations.sto"), "b.sto").table;
  EXPECT_LT((a.values - b.values).cwiseAbs().maxCoeff(), tol(1e-6));
}

TEST(PipelineTest, AMissingFileIsNamedWithItsReason) {
  TrialInput input = readSampleInput();
  input.ground_reaction.reset();
  try {
    Pipeline().run(input, readInput("models/settings/default.json"), {});
    FAIL() << "did not throw";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInputMissing);
    EXPECT_EQ(error.where().field, "grf");
  }
}

/// The error of checkInput on an upload whose files have no bytes yet.
Error findRefusal(const TrialInput& input, const std::string& settings) {
  try {
    Pipeline().checkInput(input, {"settings.json", settings});
  } catch (const Error& error) {
    return error;
  }
  return {ErrorCode::kUsage, "was accepted"};
}

TEST(CheckInput, AcceptsPartsByPresence) {
  TrialInput input;
  input.static_markers = InputFile{"static.trc", ""};
  input.markers = InputFile{"walk.trc", ""};
  input.ground_reaction = InputFile{"grf.mot", ""};
  input.mass = 70;
  input.height = 1.7;
  EXPECT_NO_THROW(Pipeline().checkInput(input, {"settings.json", "{}"}));
  input.static_markers.reset();
  EXPECT_NO_THROW(Pipeline().checkInput(input, {"settings.json", "{}"}));
}

TEST(CheckInput, NamesThePartThatIsMissing) {
  struct Case {
    void (*spoil)(TrialInput&);
    const char* settings;
    ErrorCode code;
    const char* field;
  };
  const auto nothing = [](TrialInput&) {
  };
  const std::vector<Case> cases = {
      {[](TrialInput& input) { input.static_markers.reset(); },
       R"({"scale": {"method": "static"}})",
       ErrorCode::kInputMissing,
       "static"},
      {[](TrialInput& input) { input.markers.reset(); },
       R"({"scale": {"method": "motion"}, "stages": {"last": "scale"}})",
       ErrorCode::kInputMissing,
       "markers"},
      {[](TrialInput& input) {
         input.static_markers.reset();
         input.height = 0;
       },
       R"({"stages": {"last": "scale"}})",
       ErrorCode::kInputValue,
       "height"},
      {[](TrialInput& input) { input.markers.reset(); }, "{}", ErrorCode::kInputMissing, "markers"},
      {[](TrialInput& input) { input.ground_reaction.reset(); },
       "{}",
       ErrorCode::kInputMissing,
       "grf"},
      {[](TrialInput& input) { input.mass = 0; }, "{}", ErrorCode::kInputValue, "mass"},
      {[](TrialInput& input) { input.height = 0; }, "{}", ErrorCode::kInputValue, "height"},
      {nothing, R"({"stages": {"first": "ik"}})", ErrorCode::kInputMissing, "model"},
      {[](TrialInput& input) {
         input.model = InputFile{"scaled.osim", ""};
       },
       R"({"stages": {"first": "rra"}})",
       ErrorCode::kInputMissing,
       "coordinates"},
      {nothing,
       R"({"scale": {"marker_set": "nobodys"}})",
       ErrorCode::kMarkerSetNotFound,
       "scale.marker_set"}};
  for (const Case& one : cases) {
    TrialInput input = readSampleInput();
    one.spoil(input);
    const Error error = findRefusal(input, one.settings);
    EXPECT_EQ(error.code(), one.code) << error.what();
    EXPECT_EQ(error.where().field, one.field) << error.what();
  }
}

// Markers, mass and height are enough: without a static trial the motion sizes the subject.
TEST(PipelineTest, AJobWithoutAStaticTrialScalesByTheMotion) {
  TrialInput input = readSampleInput();
  input.static_markers.reset();
  input.emg.reset();
  const PipelineResult result = Pipeline().run(input, makeSettings(R"({"last": "ik"})"), {});
  const nlohmann::json summary = nlohmann::json::parse(result.files.at("summary.json"));
  EXPECT_EQ(summary["scale"]["method"], "motion");
  const nlohmann::json& fit = summary["scale"]["motion_fit"];
  EXPECT_EQ(fit["converged"], true);
  EXPECT_EQ(fit["frames_s"].size(), 20U);
  EXPECT_EQ(fit["sizes"].size(), 11U);
  EXPECT_LT(fit["motion_rms_m"], fit["motion_rms_before_m"]);
  const TimeSeries errors = readTable(result.files.at("ik_marker_errors.sto"), "e.sto").table;
  EXPECT_NEAR(errors.values.col(errors.getColumn("marker_error_RMS")).mean(),
              fit["motion_rms_m"],
              tol(1e-6));
}

// A static trial is left aside where the settings say so.
TEST(PipelineTest, TheSettingsMayAskForTheMotion) {
  TrialInput input = readSampleInput();
  const PipelineResult with_static = Pipeline().run(
      input,
      {"settings.json", R"({"stages": {"last": "scale"}, "scale": {"method": "motion"}})"},
      {});
  input.static_markers.reset();
  const PipelineResult without = Pipeline().run(
      input,
      {"settings.json", R"({"stages": {"last": "scale"}, "scale": {"method": "motion"}})"},
      {});
  EXPECT_EQ(with_static.files.at("scaled_model.osim"), without.files.at("scaled_model.osim"));
}

// The sample's markers under other names, with a marker set that knows them.
TEST(PipelineTest, AMarkerSetOfTheInputReplacesTheNamedOne) {
  const auto rename = [](InputFile file) {
    for (std::size_t at = 0; (at = file.bytes.find("RASI", at)) != std::string::npos; at += 4) {
      file.bytes.replace(at, 4, "RASJ");  // sorts alike: the same order of sums
    }
    return file;
  };
  TrialInput input = readSampleInput();
  const InputFile settings = makeSettings(R"({"last": "ik"})", "rajagopal2016");
  const PipelineResult expected = Pipeline().run(input, settings, {});
  input.static_markers = rename(*input.static_markers);
  input.markers = rename(*input.markers);
  input.marker_set = rename(readInput("models/marker_sets/rajagopal2016.json"));
  input.model = rename(readInput("models/rajagopal2016/rajagopal2016.osim"));
  EXPECT_EQ(Pipeline().run(input, settings, {}).files.at("ik.mot"), expected.files.at("ik.mot"));
}

TEST(PipelineTest, CancellingStopsWithinAStage) {
  int calls = 0;
  PipelineEvents events;
  events.progress = [&](Stage stage, double) {
    return stage != Stage::kCmc || ++calls < 3;
  };
  try {
    Pipeline().run(readSampleInput(), readInput("models/settings/default.json"), events);
    FAIL() << "did not throw";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCancelled);
    EXPECT_EQ(error.where().stage, "cmc");
  }
}

// A marker that the marker set needs for a length is not in the standing trial.
TEST(PipelineTest, AnErrorSaysWhereInTheComputation) {
  TrialInput input = readSampleInput();
  std::string& bytes = input.static_markers->bytes;
  for (const std::string name : {"RASI", "LASI"}) {
    bytes.replace(bytes.find(name), name.size(), "GONE" + name);
  }
  try {
    Pipeline().run(input, makeSettings(R"({"last": "ik"})", "rajagopal2016"), {});
    FAIL() << "did not throw";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInputMarkers);
    EXPECT_EQ(error.where().stage, "scale");
    EXPECT_FALSE(error.where().marker.empty()) << error.what();
  }
}

TEST(PipelineTest, AMarkerSetIsAWordNotAPath) {
  nlohmann::json settings = nlohmann::json::parse(readFile("models/settings/default.json"));
  settings["scale"]["marker_set"] = "../settings/default";
  EXPECT_THROW(Pipeline().run(readSampleInput(), {"settings.json", settings.dump()}, {}), Error);
}

// Forces that are filtered keep their impulse: the low-pass has unit gain at rest.
TEST(PipelineTest, ForceFilterChangesMomentsOnlyLittle) {
  nlohmann::json settings = nlohmann::json::parse(readFile("models/settings/default.json"));
  settings["stages"] = {{"last", "id"}, {"skip", {"rra"}}};
  const TimeSeries plain =
      Pipeline().run(readSampleInput(), {"a.json", settings.dump()}, {}).tables.at("moments");
  settings["trial"]["force_lowpass_cutoff_hz"] = 20;
  const TimeSeries filtered =
      Pipeline().run(readSampleInput(), {"b.json", settings.dump()}, {}).tables.at("moments");
  const int hip = plain.getColumn("hip_flexion_r_moment");
  const double difference =
      (plain.values.col(hip) - filtered.values.col(hip)).cwiseAbs().maxCoeff();
  EXPECT_GT(difference, 0.01);
  EXPECT_LT(difference, 0.25 * plain.values.col(hip).cwiseAbs().maxCoeff());
}

// A rebuild with other formulas under the same version number is another code.
TEST(CodeVersion, NamesVersionAndSources) {
  const std::string& version = codeVersion();
  const std::size_t space = version.find(' ');
  ASSERT_NE(space, std::string::npos) << version;
  EXPECT_EQ(version.substr(0, space).find_first_not_of("0123456789."), std::string::npos);
  EXPECT_EQ(version.size() - space - 1, 16U);
  EXPECT_EQ(version.substr(space + 1).find_first_not_of("0123456789abcdef"), std::string::npos);
}

}  // namespace
}  // namespace gaitmill

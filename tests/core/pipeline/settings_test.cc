#include "core/pipeline/settings.h"

#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/io/files.h"
#include "tests/support/model_files.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

PipelineSettings readText(const std::string& json) {
  return readSettings({"settings.json", json});
}

struct BadSettings {
  const char* json;
  ErrorCode code;
  const char* field;
};

TEST(Settings, FaultsNameTheFieldAndWhatWasExpected) {
  for (const BadSettings& bad : std::vector<BadSettings>{
           {"{", ErrorCode::kSettingsJson, ""},
           {R"({"ik": {"warn_rms_m": 1e999}})", ErrorCode::kSettingsJson, ""},
           {"[]", ErrorCode::kSettingsValue, ""},
           {R"({"rra": 3})", ErrorCode::kSettingsValue, "rra"},
           {R"({"rrra": {}})", ErrorCode::kSettingsUnknownField, "rrra"},
           {R"({"cmc": {"windows_s": 0.01}})", ErrorCode::kSettingsUnknownField, "cmc.windows_s"},
           {R"({"cmc": {"window_s": "10 ms"}})", ErrorCode::kSettingsValue, "cmc.window_s"},
           {R"({"cmc": {"min_excitation": 2}})", ErrorCode::kSettingsValue, "cmc.min_excitation"},
           {R"({"cmc": {"solver": "simplex"}})", ErrorCode::kSettingsValue, "cmc.solver"},
           {R"({"rra": {"time_range_s": [1.8, 0.45]}})",
            ErrorCode::kSettingsValue,
            "rra.time_range_s"},
           {R"({"rra": {"time_range_s": [1.8]}})", ErrorCode::kSettingsValue, "rra.time_range_s"},
           {R"({"rra": {"passes": [{"weights": {"pelvis_tx": -1}}]}})",
            ErrorCode::kSettingsValue,
            "rra.passes[0].weights.pelvis_tx"},
           {R"({"stages": {"first": "cmc", "last": "ik"}})",
            ErrorCode::kSettingsValue,
            "stages.last"},
           {R"({"stages": {"first": "emg"}})", ErrorCode::kSettingsValue, "stages.first"},
           {R"({"so": {"exponent": 0.5}})", ErrorCode::kSettingsValue, "so.exponent"},
           {R"({"emg": {"source": "cooked"}})", ErrorCode::kSettingsValue, "emg.source"},
           {R"({"emg": {"band_pass_hz": [500, 50]}})",
            ErrorCode::kSettingsValue,
            "emg.band_pass_hz"},
           {R"({"emg": {"band_pass_hz": [50]}})", ErrorCode::kSettingsValue, "emg.band_pass_hz"},
           {R"({"emg": {"band_pass_order": 2.5}})",
            ErrorCode::kSettingsValue,
            "emg.band_pass_order"},
           {R"({"emg": {"critically_damped_passes": 3}})",
            ErrorCode::kSettingsValue,
            "emg.critically_damped_passes"},
           {R"({"emg": {"electromechanical_delay_s": -0.1}})",
            ErrorCode::kSettingsValue,
            "emg.electromechanical_delay_s"},
           {R"({"emg": {"channels": {"GAS": "gaslat_r"}}})",
            ErrorCode::kSettingsValue,
            "emg.channels.GAS"},
           {R"({"trial": {"force_threshold_n": -1}})",
            ErrorCode::kSettingsValue,
            "trial.force_threshold_n"}}) {
    try {
      readText(bad.json);
      ADD_FAILURE() << bad.json << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(codeName(error.code()), codeName(bad.code)) << bad.json;
      EXPECT_EQ(error.where().field, bad.field) << bad.json;
      EXPECT_EQ(error.where().file, "settings.json") << bad.json;
    }
  }
}

TEST(Settings, DeepNestingIsRefused) {
  const std::string deep =
      R"({"name": )" + std::string(100000, '[') + std::string(100000, ']') + "}";
  try {
    readText(deep);
    ADD_FAILURE() << "was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kSettingsJson);
  }
}

TEST(Settings, AnEmptyDocumentHasEveryDefault) {
  const PipelineSettings settings = readText("{}");
  EXPECT_EQ(settings.marker_set, "auto");
  EXPECT_EQ(settings.forces.reading.threshold, 20.0);
  EXPECT_EQ(settings.so.exponent, 2.0);
  EXPECT_EQ(settings.cmc.window, 0.010);
  EXPECT_TRUE(settings.runs(Stage::kScale));
  EXPECT_TRUE(settings.runs(Stage::kCmc));
}

using Json = nlohmann::ordered_json;

TEST(DefaultSettings, AreWhatAnEmptyDocumentMeans) {
  const std::string defaults = Pipeline::defaultSettings();
  EXPECT_EQ(writeSettings(readText(defaults)), defaults);
  EXPECT_EQ(writeSettings(readText("{}")), defaults);
  Json shipped = Json::parse(writeSettings(readText(readFile("models/settings/default.json"))));
  shipped["name"] = "";
  shipped["description"] = "";
  EXPECT_EQ(shipped, Json::parse(defaults));
}

TEST(Settings, EveryDocumentIsReadBackAsItIsWritten) {
  for (const std::string name : {"default", "paper_walk", "paper_run"}) {
    const std::string written =
        writeSettings(readText(readFile("models/settings/" + name + ".json")));
    EXPECT_EQ(writeSettings(readText(written)), written) << name;
  }
}

/// Paths of all objects in a document whose fields have fixed names.
std::vector<Json::json_pointer> listObjects(const Json& document) {
  std::vector<Json::json_pointer> paths;
  const std::function<void(const Json&, const Json::json_pointer&)> visit =
      [&](const Json& value, const Json::json_pointer& path) {
        const std::string name = path.empty() ? "" : path.back();
        if (!value.is_structured() || name == "coordinates" || name == "weights" ||
            name == "channels") {
          return;
        }
        if (value.is_object()) {
          paths.push_back(path);
        }
        for (const auto& [key, inner] : value.items()) {
          visit(inner, value.is_array() ? path / std::stoul(key) : path / key);
        }
      };
  visit(document, Json::json_pointer());
  return paths;
}

// At every level of the paper's documents, which hold every kind of entry.
TEST(Settings, AMisspeltFieldIsRefusedWithTheNearestName) {
  for (const std::string name : {"paper_walk", "paper_run"}) {
    const Json document =
        Json::parse(writeSettings(readText(readFile("models/settings/" + name + ".json"))));
    for (const Json::json_pointer& path : listObjects(document)) {
      for (const auto& [field, value] : document[path].items()) {
        Json spoilt = document;
        spoilt[path][field + "q"] = value;
        try {
          readText(spoilt.dump());
          ADD_FAILURE() << path << "/" << field << "q was accepted";
        } catch (const Error& error) {
          EXPECT_EQ(error.code(), ErrorCode::kSettingsUnknownField);
          EXPECT_NE(error.message().find("'" + field + "'"), std::string::npos) << error.what();
        }
      }
    }
  }
}

TEST(Settings, NullEmptiesWhatMayBeEmpty) {
  const PipelineSettings settings =
      readText(R"({"rra": {"lowpass_cutoff_hz": null, "actuators": {"residuals": null}}})");
  EXPECT_FALSE(settings.rra.lowpass_cutoff.has_value());
  EXPECT_FALSE(settings.rra.actuators.residuals.has_value());
  EXPECT_EQ(settings.rra.actuators.coordinates.at("hip_flexion"), 1000);
}

// Rajagopal et al. (2016), appendix; spec/signal.md 2 on the ends, spec/paper_metrics.md D1 on GAS.
TEST(Settings, PaperTrialsProcessEmgAsPublished) {
  for (const std::string name : {"paper_walk", "paper_run"}) {
    const EmgSettings emg = readText(readFile("models/settings/" + name + ".json")).emg;
    EXPECT_EQ(emg.processing.band_pass->low, 50) << name;
    EXPECT_EQ(emg.processing.band_pass->high, 500) << name;
    EXPECT_EQ(emg.processing.band_pass_order, 6) << name;
    EXPECT_EQ(emg.processing.butterworth, 7.5) << name;
    EXPECT_EQ(emg.processing.butterworth_order, 4) << name;
    EXPECT_EQ(emg.processing.critically_damped, 15) << name;
    EXPECT_EQ(emg.processing.critically_damped_passes, 4) << name;
    EXPECT_EQ(emg.processing.ends, EdgeTreatment::kZeroStart) << name;
    EXPECT_EQ(emg.electromechanical_delay, 0) << name;
  }
  const EmgSettings walk = readText(readFile("models/settings/paper_walk.json")).emg;
  EXPECT_EQ(walk.mapping.channels.at("GAS"), std::vector<std::string>{"gaslat_r"});
}

TEST(Settings, EmgChannelsAndStepsCanBeSet) {
  const EmgSettings emg = readText(R"({"emg": {"side": "left", "butterworth_hz": null,
      "band_pass_hz": [20, 450], "channels": {"GAS": ["gasmed_r", "gaslat_r"], "SYNC": []}}})")
                              .emg;
  EXPECT_EQ(emg.mapping.side, BodySide::kLeft);
  EXPECT_FALSE(emg.processing.butterworth.has_value());
  EXPECT_EQ(emg.processing.band_pass->high, 450);
  EXPECT_EQ(emg.mapping.channels.at("GAS").size(), 2U);
  EXPECT_TRUE(emg.mapping.channels.at("SYNC").empty());
}

TEST(Settings, StagesCanStartLateStopEarlyAndBeSkipped) {
  const PipelineSettings settings =
      readText(R"({"stages": {"first": "rra", "last": "so", "skip": ["id"]}})");
  EXPECT_FALSE(settings.runs(Stage::kIk));
  EXPECT_TRUE(settings.runs(Stage::kRra));
  EXPECT_FALSE(settings.runs(Stage::kId));
  EXPECT_TRUE(settings.runs(Stage::kSo));
  EXPECT_FALSE(settings.runs(Stage::kCmc));
}

TEST(Settings, ShippedDocumentsAreValidForTheOwnModel) {
  const ModelSpec model = readOwnModel();
  for (const std::string name : {"default", "paper_walk", "paper_run"}) {
    const std::string path = "models/settings/" + name + ".json";
    const PipelineSettings settings = readSettings({path, readFile(path)});
    EXPECT_EQ(settings.name, name);
    EXPECT_EQ(makeActuators(settings.rra.actuators, model).size(), 29U) << name;
    // 6 residuals and 10 reserves; with the model's 80 muscles and 17 torque actuators the 113 of
    // spec/cmc.md 1
    EXPECT_EQ(makeActuators(settings.cmc_actuators, model).size(), 16U) << name;
    for (const RraSettings::Pass& pass : settings.rra.passes) {
      EXPECT_EQ(fitWeights(pass, model).size(), 29U) << name;
    }
  }
}

/// Own model with coordinates renamed, unlocked or arms cut off: what other models are like.
ModelSpec renameCoordinate(ModelSpec model, const std::string& from, const std::string& to) {
  for (JointSpec& joint : model.joints) {
    for (CoordinateSpec& coordinate : joint.coordinates) {
      if (coordinate.name == from) coordinate.name = to;
    }
    for (TransformAxisSpec& axis : joint.axes) {
      if (axis.coordinate == from) axis.coordinate = to;
    }
  }
  return model;
}

ModelSpec unlockFeet(ModelSpec model) {
  for (JointSpec& joint : model.joints) {
    for (CoordinateSpec& coordinate : joint.coordinates) {
      const bool foot = coordinate.name.find("subtalar") == 0 || coordinate.name.find("mtp") == 0;
      coordinate.locked = coordinate.locked && !foot;
    }
  }
  return model;
}

TEST(Settings, DefaultsFitModelsWithOtherCoordinates) {
  const PipelineSettings settings = readText("{}");
  const ModelSpec feet = unlockFeet(readOwnModel());
  EXPECT_EQ(makeActuators(settings.rra.actuators, feet).size(), 33U);
  EXPECT_EQ(fitWeights(settings.rra.passes[0], feet).size(), 33U);
  EXPECT_EQ(fitWeights(settings.rra.passes[0], feet).at("subtalar_angle_l"), 20);
  // Muscles cross both joints of the foot.
  EXPECT_EQ(makeActuators(settings.cmc_actuators, feet).size(), 20U);

  // Toes weigh next to nothing; listed coordinates keep the gains of the published trials.
  for (const TrackingTask& task : fitTasks(settings.rra.passes[0], feet)) {
    const bool toes = task.coordinate.find("mtp") == 0 || task.coordinate.find("subtalar") == 0;
    EXPECT_EQ(task.position_gain, toes ? 1600 : 100) << task.coordinate;
    EXPECT_EQ(task.velocity_gain, toes ? 80 : 20) << task.coordinate;
  }

  const ModelSpec renamed = renameCoordinate(readOwnModel(), "lumbar_extension", "flex_extension");
  const std::map<std::string, double> weights = fitWeights(settings.rra.passes[0], renamed);
  EXPECT_EQ(weights.size(), 29U);
  EXPECT_EQ(weights.at("flex_extension"), 50);
  EXPECT_EQ(weights.count("lumbar_extension"), 0U);
  EXPECT_EQ(makeActuators(settings.rra.actuators, renamed).size(), 29U);
}

TEST(Settings, ListedCoordinatesStayStrict) {
  const ModelSpec renamed = renameCoordinate(readOwnModel(), "lumbar_extension", "flex_extension");
  const PipelineSettings listed = readText(
      R"({"rra": {"actuators": {"coordinates": {"lumbar_extension": 1000}},
                  "passes": [{"weights": {"lumbar_extension": 1}}]}})");
  EXPECT_EQ(listed.rra.actuators.others, OtherCoordinates::kNone);
  EXPECT_THROW(makeActuators(listed.rra.actuators, renamed), Error);
  EXPECT_THROW(fitWeights(listed.rra.passes[0], renamed), Error);
  const PipelineSettings loose = readText(
      R"({"rra": {"actuators": {"coordinates": {"lumbar_extension": 1000},
                                "other_coordinates": "all", "other_optimal_force": 300},
                  "passes": [{"weights": {"pelvis_tx": 1}, "other_coordinates": "all"}]}})");
  const std::vector<ActuatorSpec> actuators = makeActuators(loose.rra.actuators, renamed);
  EXPECT_EQ(actuators.size(), 29U);
  EXPECT_EQ(actuators.back().optimal_force, 300);
  EXPECT_EQ(fitWeights(loose.rra.passes[0], renamed).at("pelvis_tx"), 1);
}

TEST(Settings, ResidualsActWhereTheBaseCanMove) {
  ModelSpec planar = readOwnModel();
  for (JointSpec& joint : planar.joints) {
    for (CoordinateSpec& coordinate : joint.coordinates) {
      coordinate.locked |= coordinate.name == "pelvis_list" ||
                           coordinate.name == "pelvis_rotation" || coordinate.name == "pelvis_tz";
    }
  }
  std::vector<std::string> names;
  for (const ActuatorSpec& actuator : makeActuators(readText("{}").rra.actuators, planar)) {
    if (actuator.kind != ActuatorSpec::Kind::kCoordinate) names.push_back(actuator.name);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"FX", "FY", "MZ"}));
}

TEST(Settings, CutoffIsAutomaticUnlessStated) {
  EXPECT_TRUE(readText("{}").rra.automatic_cutoff);
  EXPECT_TRUE(readText(R"({"rra": {"lowpass_cutoff_hz": "auto"}})").rra.automatic_cutoff);
  const RraSettings none = readText(R"({"rra": {"lowpass_cutoff_hz": null}})").rra;
  EXPECT_FALSE(none.automatic_cutoff);
  EXPECT_FALSE(none.lowpass_cutoff.has_value());
  const RraSettings stated = readText(R"({"rra": {"lowpass_cutoff_hz": 12}})").rra;
  EXPECT_FALSE(stated.automatic_cutoff);
  EXPECT_EQ(stated.lowpass_cutoff.value_or(0), 12);
  EXPECT_THROW(readText(R"({"rra": {"lowpass_cutoff_hz": "high"}})"), Error);
}

TEST(Settings, AutopilotUnlessPassesAreListed) {
  EXPECT_EQ(readText("{}").rra.strategy, RraStrategy::kAutopilot);
  EXPECT_EQ(readText("{}").rra.max_passes, 6);
  const char* const listed = R"({"rra": {"passes": [{"weights": {"pelvis_tx": 1}}, {}]}})";
  EXPECT_EQ(readText(listed).rra.strategy, RraStrategy::kPasses);
  EXPECT_EQ(readText(listed).rra.max_passes, 2);
  const RraSettings start =
      readText(R"({"rra": {"strategy": "autopilot", "passes": [{"weights": {"pelvis_tx": 1}}]}})")
          .rra;
  EXPECT_EQ(start.strategy, RraStrategy::kAutopilot);
  EXPECT_EQ(start.passes[0].weights.at("pelvis_tx"), 1);
  EXPECT_EQ(start.max_passes, 6);
  for (const char* name : {"paper_walk", "paper_run"}) {
    const std::string path = "models/settings/" + std::string(name) + ".json";
    EXPECT_EQ(readSettings({path, readFile(path)}).rra.strategy, RraStrategy::kPasses) << name;
  }
}

TEST(Settings, PaperTrialsCarryTheirPublishedFigures) {
  const PipelineSettings walk = readSettings({"", readFile("models/settings/paper_walk.json")});
  EXPECT_EQ(walk.rra.passes.size(), 2U);
  EXPECT_EQ(walk.rra.passes[1].weights.at("pelvis_list"), 800);
  EXPECT_EQ(walk.cmc.excitation_limits.size(), 2U);
  EXPECT_EQ(walk.strength_height.value_or(0), 1.83);
  const PipelineSettings run = readSettings({"", readFile("models/settings/paper_run.json")});
  EXPECT_EQ(run.rra.passes.size(), 3U);
  EXPECT_EQ(run.rra.passes[2].range->start, 0.82);
  const ModelSpec model = readOwnModel();
  const std::map<std::string, double> third = expandSides(run.rra.passes[2].weights, model);
  EXPECT_EQ(third.at("hip_flexion_r"), 75);
  EXPECT_EQ(third.at("hip_flexion_l"), 25);
  EXPECT_EQ(third.at("hip_adduction_r"), 25);
  EXPECT_EQ(third.at("hip_adduction_l"), 50);
  EXPECT_EQ(run.cmc.excitation_limits.size(), 4U);
}

TEST(Settings, DefaultPresumesNoMuscleOffAndActsAtThePelvisMassCentre) {
  const PipelineSettings settings = readSettings({"", readFile("models/settings/default.json")});
  EXPECT_TRUE(settings.cmc.excitation_limits.empty());
  const ModelSpec model = readOwnModel();
  const std::vector<ActuatorSpec> actuators = makeActuators(settings.cmc_actuators, model);
  const Eigen::Vector3d pelvis =
      model.bodies[static_cast<std::size_t>(model.findBody("pelvis"))].mass_center;
  int forces = 0;
  for (const ActuatorSpec& actuator : actuators) {
    if (actuator.kind == ActuatorSpec::Kind::kPoint) {
      EXPECT_EQ((actuator.point - pelvis).norm(), 0.0);
      ++forces;
    }
  }
  EXPECT_EQ(forces, 3);
}

TEST(ExpandSides, AnUnknownCoordinateNamesTheNearest) {
  try {
    expandSides({{"hip_flexon", 1.0}}, readOwnModel());
    FAIL() << "did not throw";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInputCoordinates);
    EXPECT_EQ(error.where().coordinate, "hip_flexon");
    EXPECT_NE(error.message().find("hip_flexion"), std::string::npos);
  }
}

}  // namespace
}  // namespace gaitmill

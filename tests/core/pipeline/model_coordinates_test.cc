#include "core/pipeline/model_coordinates.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/io/osim_writer.h"
#include "core/pipeline/pipeline.h"
#include "core/pipeline/settings.h"
#include "tests/support/model_files.h"
#include "tests/support/sample_input.h"
#include "tests/support/shared_data.h"
#include "tests/support/simple_models.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

const ModelCoordinate& find(const std::vector<ModelCoordinate>& all, const std::string& name) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.name == name; });
  EXPECT_NE(found, all.end()) << name;
  return *found;
}

TEST(ModelCoordinates, OfTheOwnModel) {
  const std::vector<ModelCoordinate> all = listFreeCoordinates(readOwnModel(), "pelvis");
  EXPECT_EQ(all.size(), 29U);
  const ModelCoordinate& height = find(all, "pelvis_ty");
  EXPECT_TRUE(height.at_root && height.translation);
  EXPECT_EQ(height.root_axis, 1);
  EXPECT_NEAR(height.moved_share, 1, tol(1e-12));
  EXPECT_EQ(find(all, "pelvis_tilt").root_axis, 2);
  const ModelCoordinate& knee = find(all, "knee_angle_r");
  EXPECT_FALSE(knee.at_root || knee.translation || knee.has_actuator);
  EXPECT_TRUE(knee.has_muscle);
  const ModelCoordinate& elbow = find(all, "elbow_flex_l");
  EXPECT_TRUE(elbow.has_actuator);
  EXPECT_FALSE(elbow.has_muscle);
  EXPECT_GT(find(all, "lumbar_bending").moved_share, 0.4);
}

TEST(ModelCoordinates, ArmsWithoutActuatorsGetTorques) {
  ModelSpec model = readOwnModel();
  EXPECT_TRUE(addTorqueActuators(model).empty());
  const std::size_t own = model.actuators.size();
  model.actuators.clear();
  // Lumbar joint and arms; wrists are locked.
  EXPECT_EQ(addTorqueActuators(model).size(), 13U);
  EXPECT_EQ(own, 17U);
  EXPECT_EQ(model.actuators.front().optimal_force, 10);
  EXPECT_TRUE(addTorqueActuators(model).empty());
}

TEST(ModelCoordinates, BaseAndTrunkAreFoundByWhatTheyAre) {
  const ModelSpec own = readOwnModel();
  EXPECT_EQ(findBase("pelvis", own), "pelvis");
  EXPECT_EQ(findTrunk("torso", own), "torso");
  const ModelSpec slider = makeSlider("cart");
  EXPECT_EQ(findBase("pelvis", slider), "cart");
  EXPECT_EQ(findTrunk("torso", slider), "cart");
}

class OtherModels : public SharedDataTest {
 protected:
  static PipelineSettings readDefault() {
    return readSettings({"default.json", readFile("models/settings/default.json")});
  }
};

// Residual reduction has a unique answer only with as many actuators as free coordinates.
TEST_F(OtherModels, DefaultsDriveEveryFreeCoordinateOfEachDocument) {
  const PipelineSettings settings = readDefault();
  for (const char* name : {"models/FullBodyModel_Hamner2010_v2_0.osim",
                           "models/Rajagopal2015.osim",
                           "models/gait2392_thelen2003muscle.osim",
                           "models/gait2392_millard2012muscle.osim",
                           "walk/example3DWalking/subject_walk_scaled.osim"}) {
    SCOPED_TRACE(name);
    ModelSpec model = readModelFile(shared(std::string("data/") + name));
    const std::size_t free = listFreeCoordinates(model, "pelvis").size();
    EXPECT_GE(free, 23U);
    EXPECT_EQ(makeActuators(settings.rra.actuators, model).size(), free);
    EXPECT_EQ(fitTasks(settings.rra.passes[0], model).size(), free);
    // Something moves every joint.
    addTorqueActuators(model);
    for (const ModelCoordinate& coordinate : listFreeCoordinates(model, "pelvis")) {
      EXPECT_TRUE(coordinate.at_root || coordinate.has_muscle || coordinate.has_actuator)
          << coordinate.name;
    }
    EXPECT_FALSE(makeActuators(settings.cmc_actuators, model).empty());
  }
}

// The runner of 2010 on the model of 2010, as heavy as he is: other joints than our own model, no
// actuators at the arms, weights that no list names.
TEST_F(OtherModels, ResidualReductionHoldsItsLimitsOnTheRunnerOf2010) {
  ModelSpec model = readModelFile(shared("data/models/FullBodyModel_Hamner2010_v2_0.osim"));
  setTotalMass(model, 65.9, InertiaScaling::kWithMass);
  TrialInput input;
  input.model = InputFile{"runner.osim", writeOsim(model)};
  const std::string folder = shared("data/run/hamner2010/");
  input.coordinates = readInput(folder + "reference/subject02_running_ik.mot");
  input.ground_reaction = readInput(folder + "subject02_running_grf.mot");
  input.mass = 65.9;
  input.height = 1.75;
  const char* const settings = R"({"stages": {"first": "rra", "last": "rra"},
                                   "rra": {"time_range_s": [0.7, 1.6]}})";
  const PipelineResult result = Pipeline().run(input, {"settings.json", settings}, {});
  const auto summary = nlohmann::json::parse(result.summary_json);
  EXPECT_TRUE(summary["rra"]["limits_hold"].get<bool>());
  EXPECT_EQ(summary["rra"]["lowpass_cutoff_hz"], 15);
  for (const auto& check : summary["quality"]["checks"]) {
    if (check["stage"] == "rra") {
      EXPECT_NE(check["verdict"], "fail") << check["figure"];
    }
  }
  EXPECT_TRUE(std::any_of(result.warnings.begin(), result.warnings.end(), [](const auto& warning) {
    return warning.find("torque actuators") != std::string::npos;
  }));
}

}  // namespace
}  // namespace gaitmill

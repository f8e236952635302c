#include "core/pipeline/model_coordinates.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/model_files.h"
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

}  // namespace
}  // namespace gaitmill

#include "core/intake/landmarks.h"

#include <set>

#include <gtest/gtest.h>

#include "core/io/files.h"
#include "core/io/osim_reader.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

ModelSpec readOwnModel() {
  const std::string path = "models/rajagopal2016/rajagopal2016.osim";
  return readOsim(readFile(path), path);
}

TEST(Landmarks, NamesAreUnique) {
  std::set<std::string> names;
  for (const Landmark& landmark : landmarks()) {
    EXPECT_TRUE(names.insert(landmark.name).second) << landmark.name;
    EXPECT_EQ(findLandmark(landmark.name), &landmark);
    EXPECT_GT(landmark.placement_deviation, 0.005) << landmark.name;
    EXPECT_LE(landmark.placement_deviation, 0.05) << landmark.name;
  }
  EXPECT_EQ(findLandmark("rasi"), nullptr);
}

TEST(Landmarks, EachSideMirrorsTheOther) {
  for (const Landmark& landmark : landmarks()) {
    const Landmark* other = findOpposite(landmark.name);
    ASSERT_NE(other, nullptr) << landmark.name;
    const Eigen::Vector3d mirrored = landmark.location.cwiseProduct(Eigen::Vector3d(1, 1, -1));
    EXPECT_EQ(other->location, mirrored) << landmark.name;
    EXPECT_EQ(landmark.side == Side::kMiddle, other == &landmark) << landmark.name;
  }
}

// Rajagopal2016 carries its own markers; those of the middle stand up to 17 mm off it, and one of
// the shoulder 8 mm off its mirror image.
TEST(Landmarks, StandWhereTheModelHasThem) {
  const ModelSpec model = readOwnModel();
  int compared = 0;
  for (const MarkerSpec& marker : model.markers) {
    const Landmark* landmark = findLandmark(marker.name);
    if (landmark == nullptr) {
      continue;
    }
    ++compared;
    EXPECT_EQ(landmark->body, marker.body) << marker.name;
    const double margin = marker.name == "CLAV"   ? 0.0171
                          : marker.name == "LPSH" ? 0.0081
                          : marker.name == "C7"   ? 0.0017
                                                  : 2e-6;
    EXPECT_LT((landmark->location - marker.location).norm(), tol(margin)) << marker.name;
  }
  EXPECT_EQ(compared, 64);
}

TEST(Landmarks, HaveBodiesOfTheModels) {
  const ModelSpec model = readOwnModel();
  for (const Landmark& landmark : landmarks()) {
    EXPECT_EQ(findModelBody(landmark.body, model), landmark.body) << landmark.name;
  }
  ModelSpec leg;
  leg.bodies.resize(2);
  leg.bodies[0].name = "femur";
  leg.bodies[1].name = "Thorax";
  EXPECT_EQ(findModelBody("femur_r", leg), "femur");
  EXPECT_EQ(findModelBody("femur_l", leg), std::nullopt);
  EXPECT_EQ(findModelBody("torso", leg), "Thorax");
}

// Heights over the floor of a man of 1.70 m: soles 0.93 m below the pelvis origin.
TEST(Landmarks, StandOnTopOfEachOther) {
  const auto height = [](const char* name) {
    return calcStandingPosition(*findLandmark(name)).y();
  };
  EXPECT_GT(height("TOPH"), height("RACR"));
  EXPECT_GT(height("RACR"), height("XIPH"));
  EXPECT_GT(height("XIPH"), height("RASI"));
  EXPECT_GT(height("RASI"), height("RGTR"));
  EXPECT_GT(height("RGTR"), height("RLFC"));
  EXPECT_GT(height("RLFC"), height("RTTU"));
  EXPECT_GT(height("RTTU"), height("RLMAL"));
  EXPECT_GT(height("RLMAL"), height("RMT5"));
  EXPECT_NEAR(height("TOPH") - height("RCALfloor"), 1.70, tol(0.03));
  EXPECT_NEAR(calcStandingPosition(*findLandmark("LTOE")).z(), -0.0539, tol(1e-3));
}

}  // namespace
}  // namespace gaitmill

#include "core/figure/muscle_names.h"

#include <set>

#include <gtest/gtest.h>

#include "core/io/files.h"
#include "core/io/osim_reader.h"

namespace gaitmill {
namespace {

TEST(MuscleNames, CoverEveryMuscleOfTheModelOnce) {
  const ModelSpec model = readOsim(readFile("models/rajagopal2016/rajagopal2016.osim"), "model");
  std::set<std::string> displays;
  for (const MuscleSpec& muscle : model.muscles) {
    const SidedName name = splitSide(muscle.name);
    const MuscleName found = findMuscleName(name.base);
    EXPECT_NE(name.side, Side::kNone) << muscle.name;
    EXPECT_NE(found.display, found.base) << muscle.name;
    displays.insert(std::string(sideWord(name.side)) + found.display);
  }
  EXPECT_EQ(displays.size(), 80U);
  EXPECT_EQ(knownMuscles().size(), 40U);
}

TEST(MuscleNames, OfOtherModelsAreMadeReadable) {
  EXPECT_EQ(findMuscleName("med_gas").display, "Med gas");
  EXPECT_EQ(findMuscleName("med_gas").group, MuscleGroup::kOthers);
}

TEST(SplitSide, FindsTheLetterAtTheEndOrInside) {
  EXPECT_EQ(splitSide("soleus_r").base, "soleus");
  EXPECT_EQ(splitSide("soleus_r").side, Side::kRight);
  EXPECT_EQ(splitSide("knee_angle_l_moment").base, "knee_angle_moment");
  EXPECT_EQ(splitSide("knee_angle_l_moment").side, Side::kLeft);
  EXPECT_EQ(splitSide("hip_flexion_r_reserve").base, "hip_flexion_reserve");
  EXPECT_EQ(splitSide("pelvis_rotation").side, Side::kNone);
  EXPECT_EQ(splitSide("lumbar_rotation").base, "lumbar_rotation");
}

}  // namespace
}  // namespace gaitmill

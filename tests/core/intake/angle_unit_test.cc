#include "core/intake/angle_unit.h"

#include <gtest/gtest.h>

#include "tests/support/refusal.h"

namespace gaitmill {
namespace {

// "Degrees against radians": a knee of 66 degrees, as files of four kinds have it.
TEST(AngleUnit, NumbersTellWhatTheHeaderDoesNot) {
  Decisions decisions;
  EXPECT_TRUE(decideAngleUnit(66, {true, true}, std::nullopt, decisions));
  EXPECT_FALSE(decideAngleUnit(1.15, {false, true}, std::nullopt, decisions));
  EXPECT_EQ(decisions[0].origin, Decision::Origin::kStated);
  // Not stated and guessed wrong from the kind of file.
  EXPECT_FALSE(decideAngleUnit(1.15, {true, false}, std::nullopt, decisions));
  EXPECT_TRUE(decideAngleUnit(66, {false, false}, std::nullopt, decisions));
  EXPECT_EQ(decisions[3].origin, Decision::Origin::kDetected);
  EXPECT_EQ(decisions[3].value, "deg");
}

TEST(AngleUnit, AHeaderThatCannotBeIsRefusedWithBothReadings) {
  Decisions decisions;
  GAITMILL_EXPECT_ERROR(decideAngleUnit(1.15, {true, true}, std::nullopt, decisions),
                        kInputAmbiguous,
                        "the header says degrees; read in degrees, the largest joint angle is 1.15 "
                        "degrees, but read in radians, the largest joint angle is 65.89 degrees");
  GAITMILL_EXPECT_ERROR(decideAngleUnit(66, {false, true}, std::nullopt, decisions),
                        kInputAmbiguous,
                        "trial.angle_units");
  EXPECT_TRUE(decideAngleUnit(1.15, {true, true}, true, decisions));
  EXPECT_EQ(decisions.back().origin, Decision::Origin::kSet);
}

}  // namespace
}  // namespace gaitmill

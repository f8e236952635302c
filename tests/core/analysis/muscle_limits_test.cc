#include "core/analysis/muscle_limits.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

TEST(Saturation, IsTheLongestTimeWithoutABreak) {
  TimeSeries controls =
      makeTimeSeries("excitations", {"soleus_r", "psoas_r"}, {0.0, 0.1, 0.3, 0.4, 0.5, 0.9});
  controls.values << 1, 0.2, 1, 0.98, 0.5, 0.2, 1, 0.2, 1, 1, 1, 0.3;
  const std::vector<Saturation> found = calcSaturation(controls, {"psoas_r", "soleus_r"}, 0.99);
  EXPECT_EQ(found[0].muscle, "psoas_r");
  EXPECT_EQ(found[0].longest_span, 0) << "a single row lasts no time";
  EXPECT_NEAR(found[1].longest_span, 0.5, tol(1e-15)) << "from 0.4 to 0.9 s, not from 0 to 0.1 s";
}

TEST(Saturation, UnknownMusclesAreAnError) {
  const TimeSeries controls = makeTimeSeries("excitations", {"soleus_r"}, {0.0});
  EXPECT_THROW(calcSaturation(controls, {"soleus"}, 0.99), Error);
}

class FiberRangeTest : public ::testing::Test {
 protected:
  TimeSeries lengths_ = makeTimeSeries("lengths", {"a", "b"}, {0.0, 1.0, 2.0});
  TimeSeries forces_ = makeTimeSeries("forces", {"a", "b"}, {0.0, 1.0, 2.0});
};

// Trapezoid weights 0.5, 1, 0.5 s: a gives 100 N s of which 25 at 0.4 l0M, b gives 100 N s inside.
TEST_F(FiberRangeTest, WeighsExcursionsByTheForceGivenThere) {
  lengths_.values << 0.4, 1.0, 1.0, 1.1, 1.2, 1.4;
  forces_.values << 50, 50, 50, 50, 50, 50;
  const std::vector<FiberRange> ranges = calcFiberRanges(lengths_, forces_, 0.5, 1.5);
  EXPECT_EQ(ranges[0].shortest, 0.4);
  EXPECT_EQ(ranges[0].longest, 1.2);
  EXPECT_NEAR(ranges[0].outside_fraction, 0.25, tol(1e-15));
  EXPECT_NEAR(ranges[0].impulse_share, 0.125, tol(1e-15));
  EXPECT_EQ(ranges[1].outside_fraction, 0);
  EXPECT_EQ(ranges[1].impulse_share, 0);
}

TEST_F(FiberRangeTest, AMuscleWithoutActiveForceIsNowhereOutside) {
  lengths_.values << 0.4, 1.0, 0.4, 1.1, 1.6, 1.4;
  forces_.values << 0, 50, -3, 50, 0, 50;
  const std::vector<FiberRange> ranges = calcFiberRanges(lengths_, forces_, 0.5, 1.5);
  EXPECT_EQ(ranges[0].outside_fraction, 0);
  EXPECT_EQ(ranges[0].impulse_share, 0);
}

}  // namespace
}  // namespace gaitmill

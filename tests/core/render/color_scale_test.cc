#include "core/render/color_scale.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

double findLightness(MuscleColor color, double value) {
  return toLab(getColorScale(color).findColor(value))[0];
}

TEST(ColorScale, ActivationGoesFromBlueToRed) {
  const ColorScale& scale = getColorScale(MuscleColor::kActivation);
  const Rgb rest = scale.findColor(0), full = scale.findColor(1);
  EXPECT_GT(rest[2], 2 * rest[0]);
  EXPECT_GT(rest[2], 2 * rest[1]);
  EXPECT_GT(full[0], 5 * full[1]);
  EXPECT_GT(full[0], 5 * full[2]);
}

TEST(ColorScale, ForceBrightensAllTheWay) {
  for (double share = 0; share < 0.99; share += 0.05) {
    EXPECT_LT(findLightness(MuscleColor::kForce, share),
              findLightness(MuscleColor::kForce, share + 0.05));
  }
}

TEST(ColorScale, FiberLengthIsLightestAtTheOptimum) {
  const double middle = findLightness(MuscleColor::kFiberLength, 1);
  for (const double away : {0.1, 0.3, 0.5}) {
    EXPECT_LT(findLightness(MuscleColor::kFiberLength, 1 - away), middle);
    EXPECT_LT(findLightness(MuscleColor::kFiberLength, 1 + away), middle);
  }
}

// Steps of one twentieth must be seen anywhere on the scale, so that no range of values hides.
TEST(ColorScale, EqualStepsAreSeenEverywhere) {
  for (const MuscleColor color :
       {MuscleColor::kActivation, MuscleColor::kForce, MuscleColor::kFiberLength}) {
    const ColorScale& scale = getColorScale(color);
    const double step = 0.05 * (scale.highest - scale.lowest);
    for (int i = 0; i < 20; ++i) {
      const auto a = toLab(scale.findColor(scale.lowest + i * step));
      const auto b = toLab(scale.findColor(scale.lowest + (i + 1) * step));
      const double difference = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
      EXPECT_GT(difference, 2.3) << scale.title << " step " << i;  // just noticeable (Mahy 1994)
      EXPECT_LT(difference, 15) << scale.title << " step " << i;
    }
  }
}

TEST(ColorScale, ValuesBeyondTheEndsKeepTheEndsColor) {
  const ColorScale& scale = getColorScale(MuscleColor::kActivation);
  EXPECT_EQ(scale.findColor(-3), scale.findColor(0));
  EXPECT_EQ(scale.findColor(7), scale.findColor(1));
  EXPECT_EQ(scale.findColor(std::numeric_limits<double>::infinity()), scale.findColor(1));
}

TEST(ColorScale, WhatIsNotKnownIsGrey) {
  const ColorScale& scale = getColorScale(MuscleColor::kForce);
  EXPECT_EQ(scale.findColor(std::numeric_limits<double>::quiet_NaN()), kUnknownMuscle);
}

TEST(Lab, WhiteBlackAndRedAreAsPublished) {
  const auto white = toLab({255, 255, 255});
  EXPECT_NEAR(white[0], 100, tol(0.01));
  EXPECT_NEAR(std::hypot(white[1], white[2]), 0, tol(0.02));
  EXPECT_NEAR(toLab({0, 0, 0})[0], 0, tol(1e-9));
  const auto red = toLab({255, 0, 0});  // 53.24, 80.09, 67.20 (D65)
  EXPECT_NEAR(red[0], 53.24, tol(0.02));
  EXPECT_NEAR(red[1], 80.09, tol(0.03));
  EXPECT_NEAR(red[2], 67.20, tol(0.03));
}

TEST(Lab, ThereAndBackIsTheSameColor) {
  for (const int r : {0, 60, 255}) {
    for (const int g : {0, 130, 255}) {
      for (const int b : {0, 200, 255}) {
        const Rgb color{static_cast<std::uint8_t>(r),
                        static_cast<std::uint8_t>(g),
                        static_cast<std::uint8_t>(b)};
        EXPECT_EQ(fromLab(toLab(color)), color);
      }
    }
  }
}

}  // namespace
}  // namespace gaitmill

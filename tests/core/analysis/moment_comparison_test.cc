#include "core/analysis/moment_comparison.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

// One column on 0..1 s, rows every 1 %.
template <class Function>
TimeSeries makeCurve(const std::string& label, Function value) {
  std::vector<double> time;
  for (int i = 0; i <= 100; ++i) {
    time.push_back(0.01 * i);
  }
  TimeSeries table = makeTimeSeries("curve", {label}, time);
  for (int i = 0; i <= 100; ++i) {
    table.values(i, 0) = value(0.01 * i);
  }
  return table;
}

constexpr GaitCycle kCycle{0, 1};

TEST(CompareMoments, ConstantDifferenceIsItsOwnRms) {
  const auto id = makeCurve("knee_angle_r_moment", [](double t) { return -60 - 40 * t; });
  const auto muscle = makeCurve("knee_angle_r", [](double t) { return -58 - 40 * t; });
  const auto result = compareMoments(id, muscle, {"knee_angle_r", -1}, kCycle);
  EXPECT_EQ(result.instants, 101);
  EXPECT_NEAR(result.rmse, 2, tol(1e-12));
  EXPECT_NEAR(result.peak, 100, tol(1e-12));  // extension is positive
  EXPECT_NEAR(result.rmse_percent_of_peak, 2, tol(1e-12));
  EXPECT_NEAR(result.peak_difference, 2, tol(1e-12));
  EXPECT_EQ(result.fraction_at_90_percent, 1.0);
  EXPECT_NEAR(result.worst_share, 2.0 / 60.0, tol(1e-12));
  EXPECT_EQ(result.worst_percent, 0);
}

TEST(CompareMoments, SineOfTheDifferenceHasRmsOneOverRootTwo) {
  const auto id = makeCurve("hip_flexion_r_moment", [](double) { return 50.0; });
  const auto muscle =
      makeCurve("hip_flexion_r_moment", [](double t) { return 50 - 3 * std::sin(2 * kPi * t); });
  const auto result = compareMoments(id, muscle, {"hip_flexion_r", 1}, kCycle);
  // 101 samples, the first and the last both zero of the sine: 100/101 of the mean over a period.
  EXPECT_NEAR(result.rmse, 3 * std::sqrt(0.5 * 100.0 / 101.0), tol(1e-12));
  EXPECT_NEAR(result.peak_difference, 3, tol(1e-12));
}

TEST(CompareMoments, FloorCarriesTheZeroCrossing) {
  // ID runs from -100 to 100; a difference of 0.4 is below 10 % of the floor of 5 N.m everywhere.
  const auto id = makeCurve("ankle_angle_r_moment", [](double t) { return 200 * t - 100; });
  const auto near = makeCurve("ankle_angle_r", [](double t) { return 200 * t - 100 + 0.4; });
  EXPECT_EQ(compareMoments(id, near, {"ankle_angle_r", -1}, kCycle).fraction_at_90_percent, 1.0);
  // 0.6 is above it where |ID| < 6: the rows at -4, -2, 0, 2, 4.
  const auto far = makeCurve("ankle_angle_r", [](double t) { return 200 * t - 100 + 0.6; });
  const auto result = compareMoments(id, far, {"ankle_angle_r", -1}, kCycle);
  EXPECT_NEAR(result.fraction_at_90_percent, 96.0 / 101.0, tol(1e-12));
  EXPECT_NEAR(result.worst_share, 0.12, tol(1e-12));
}

TEST(CompareMoments, RecordsWithoutACommonInstantGiveNaN) {
  const auto id = makeCurve("hip_flexion_r_moment", [](double) { return 1.0; });
  const auto result = compareMoments(id, id, {"hip_flexion_r", 1}, {5, 6});
  EXPECT_EQ(result.instants, 0);
  EXPECT_TRUE(std::isnan(result.rmse));
  EXPECT_TRUE(std::isnan(calcFractionAt90Percent({result})));
}

TEST(CompareMoments, UnknownColumnIsAnError) {
  const auto id = makeCurve("hip_flexion_r_moment", [](double) { return 1.0; });
  EXPECT_THROW(compareMoments(id, id, {"knee_angle_r", -1}, kCycle), Error);
}

TEST(FractionAt90Percent, CountsEveryPairOfMomentAndInstant) {
  MomentComparison a{};
  a.instants = 100;
  a.fraction_at_90_percent = 1.0;
  MomentComparison b = a;
  b.instants = 300;
  b.fraction_at_90_percent = 0.5;
  EXPECT_NEAR(calcFractionAt90Percent({a, b}), 250.0 / 400.0, tol(1e-15));
}

}  // namespace
}  // namespace gaitmill

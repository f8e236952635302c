#include "core/analysis/work.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

TimeSeries makePower(const std::vector<double>& time, const std::vector<double>& values) {
  TimeSeries table = makeTimeSeries("power", {"m"}, time);
  for (std::size_t i = 0; i < values.size(); ++i) {
    table.values(static_cast<Eigen::Index>(i), 0) = values[i];
  }
  return table;
}

// From -1 to 3 W in a second: zero at 0.25 s, triangles of 0.125 and 1.125 J.
TEST(IntegratePower, SplitsAPieceWhereItCrossesZero) {
  const SignedWork rising = integratePower(makePower({0, 1}, {-1, 3}), 0);
  EXPECT_NEAR(rising.negative, -0.125, tol(1e-15));
  EXPECT_NEAR(rising.positive, 1.125, tol(1e-15));
  const SignedWork falling = integratePower(makePower({0, 1}, {3, -1}), 0);
  EXPECT_NEAR(falling.negative, -0.125, tol(1e-15));
  EXPECT_NEAR(falling.positive, 1.125, tol(1e-15));
}

// Over a whole sine both halves are amplitude * period / pi; trapezoids of 1 ms miss 1e-6 of it.
TEST(IntegratePower, OfASineGivesEqualHalves) {
  std::vector<double> time;
  std::vector<double> values;
  for (int i = 0; i <= 1000; ++i) {
    time.push_back(0.001 * i);
    values.push_back(50 * std::sin(2 * kPi * time.back()));
  }
  const SignedWork work = integratePower(makePower(time, values), 0);
  EXPECT_NEAR(work.positive, 50 / kPi, tol(1e-4));
  EXPECT_NEAR(work.negative, -50 / kPi, tol(1e-4));
}

TEST(CutInterval, InterpolatesBothEnds) {
  const TimeSeries cut = cutInterval(makePower({0, 1, 2, 3}, {0, 10, 20, 30}), 0.5, 2.0);
  EXPECT_EQ(cut.time, (std::vector<double>{0.5, 1, 2}));
  EXPECT_NEAR(cut.values(0, 0), 5, tol(1e-15));
  EXPECT_NEAR(cut.values(2, 0), 20, tol(1e-15));
}

TEST(FindCoveredCycle, TakesAsMuchTimeFromWhereTheRecordStarts) {
  const GaitCycle cycle{0.25, 1.39};
  const auto inside = findCoveredCycle(cycle, 0.0, 2.0);
  ASSERT_TRUE(inside.has_value());
  EXPECT_EQ(inside->start, 0.25);
  const auto later = findCoveredCycle(cycle, 0.5, 2.0);
  ASSERT_TRUE(later.has_value());
  EXPECT_EQ(later->start, 0.5);
  EXPECT_NEAR(later->end, 1.64, tol(1e-15));
  EXPECT_FALSE(findCoveredCycle(cycle, 0.5, 1.5).has_value());  // ends too early
  EXPECT_FALSE(findCoveredCycle(cycle, 1.5, 9.0).has_value());  // starts after the cycle
}

TEST(MuscleWork, IsOneRowPerCoveredCycle) {
  MuscleAnalysis muscles;
  const std::vector<double> time = {0, 1, 2, 3};
  muscles.fiber_active_powers = makePower(time, {2, 2, 2, 2});
  muscles.fiber_passive_powers = makePower(time, {-0.5, -0.5, -0.5, -0.5});
  muscles.tendon_powers = makePower(time, {-1, -1, -1, -1});
  muscles.muscle_powers = makePower(time, {0.5, 0.5, 0.5, 0.5});
  const TimeSeries work = calcMuscleWork(muscles, {{0, 1}, {1, 3}, {2.5, 4}});
  EXPECT_EQ(work.time, (std::vector<double>{0, 1}));
  EXPECT_EQ(work.labels[0], "m_fiber_positive_work");
  EXPECT_EQ(work.labels[4], "m_net_work");
  const std::vector<double> second = {3, 0, 0, -2, 1};
  for (std::size_t i = 0; i < second.size(); ++i) {
    EXPECT_NEAR(work.values(1, static_cast<Eigen::Index>(i)), second[i], tol(1e-14)) << i;
  }
}

}  // namespace
}  // namespace gaitmill

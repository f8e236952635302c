#include "core/analysis/gait_cycle.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

// Strikes of the published walking trial (spec/signal.md 7.1).
constexpr GaitCycle kWalk{0.248, 1.3925};

TEST(CyclePercent, PercentAndTimeAreInverse) {
  EXPECT_NEAR(calcPercent(kWalk, 1.047), 69.8, tol(0.02));  // right toe-off as published
  EXPECT_NEAR(calcCycleTime(kWalk, calcPercent(kWalk, 0.9)), 0.9, tol(1e-15));
}

TEST(ComparisonGrid, CompleteRecordGivesEachPercentOnce) {
  const auto grid = makeComparisonGrid({0.0, 1.0}, -0.1, 1.2);
  ASSERT_EQ(grid.size(), 101U);
  EXPECT_EQ(grid.front().percent, 0);
  EXPECT_EQ(grid.back().percent, 100);
}

TEST(ComparisonGrid, RealignsThePublishedWalkAtItsSeam) {
  const auto grid = makeComparisonGrid(kWalk, 0.45, 1.80, 25);
  ASSERT_EQ(grid.size(), 102U);  // 25..100, then 0..25
  EXPECT_EQ(grid[0].percent, 25);
  EXPECT_EQ(grid[75].percent, 100);
  EXPECT_EQ(grid[76].percent, 0);
  EXPECT_NEAR(grid[76].time, kWalk.end, tol(1e-12));
  EXPECT_EQ(grid[101].percent, 25);
}

TEST(ComparisonGrid, LeavesOutWhatTheRecordDoesNotCover) {
  // The published running simulation ends at 98.5 % of the cycle.
  const auto grid = makeComparisonGrid({0.863, 1.546}, 0.83, 1.536, 0);
  ASSERT_EQ(grid.size(), 99U);
  EXPECT_EQ(grid.back().percent, 98);
}

TEST(ComparisonGrid, FirstCoveredPercentIsTheDefaultSeam) {
  const auto grid = makeComparisonGrid({0.0, 1.0}, 0.174, 1.4);
  EXPECT_EQ(grid.front().percent, 18);
  EXPECT_EQ(grid.back().percent, 18);
  EXPECT_EQ(grid.size(), 102U);
}

TEST(ComparisonGrid, StrikesInTheWrongOrderAreRefused) {
  EXPECT_THROW(makeComparisonGrid({1.0, 1.0}, 0, 2), Error);
}

}  // namespace
}  // namespace gaitmill

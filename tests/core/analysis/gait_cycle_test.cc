#include "core/analysis/gait_cycle.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

// A table whose only column is its own time, 10 ms rows.
TimeSeries makeClock(double first, double last) {
  std::vector<double> time;
  const int count = static_cast<int>(std::lround((last - first) / 0.01));
  for (int i = 0; i <= count; ++i) {
    time.push_back(first + 0.01 * i);
  }
  TimeSeries table = makeTimeSeries("clock", {"t"}, time);
  for (int i = 0; i <= count; ++i) {
    table.values(i, 0) = time[static_cast<std::size_t>(i)];
  }
  return table;
}

// Strikes of the published walking trial (spec/signal.md 7.1).
constexpr GaitCycle kWalk{0.248, 1.3925};

TEST(GaitCycle, PercentAndTimeAreInverse) {
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
  EXPECT_NEAR(grid[76].time, kWalk.second_strike, tol(1e-12));
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

TEST(NormalizeToCycle, ReadsBelowTheSeamOneCycleLater) {
  const TimeSeries table = normalizeToCycle(makeClock(0.45, 1.80), kWalk, 25);
  ASSERT_EQ(table.rowCount(), 101);
  EXPECT_NEAR(table.values(25, 0), calcCycleTime(kWalk, 25), tol(1e-12));
  EXPECT_NEAR(table.values(24, 0), calcCycleTime(kWalk, 124), tol(1e-12));
  EXPECT_NEAR(table.values(0, 0), table.values(100, 0), tol(1e-12));
}

TEST(NormalizeToCycle, ReadsTheEndOneCycleEarlierIfTheRecordStopsShort) {
  const TimeSeries table = normalizeToCycle(makeClock(-0.1, 0.95), {0.0, 1.0});
  EXPECT_NEAR(table.values(95, 0), 0.95, tol(1e-12));
  EXPECT_NEAR(table.values(97, 0), -0.03, tol(1e-12));
}

TEST(NormalizeToCycle, MissingInstantsAreNotANumber) {
  const TimeSeries table = normalizeToCycle(makeClock(0.3, 0.8), {0.0, 1.0}, 0);
  EXPECT_TRUE(std::isnan(table.values(29, 0)));
  EXPECT_NEAR(table.values(30, 0), 0.3, tol(1e-12));
  EXPECT_NEAR(table.values(80, 0), 0.8, tol(1e-12));
  EXPECT_TRUE(std::isnan(table.values(81, 0)));
}

}  // namespace
}  // namespace gaitmill

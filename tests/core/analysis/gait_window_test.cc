#include "core/analysis/gait_window.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr TimeRange kRecord{0, 10};

std::vector<NumberedCycle> makeCycles() {
  return {{Foot::kRight, 1, {1.0, 2.0}},
          {Foot::kRight, 2, {2.0, 3.0}},
          {Foot::kLeft, 1, {1.5, 2.5}},
          {Foot::kLeft, 2, {2.5, 3.5}}};
}

SimulatedWindow choose(const std::vector<TimeRange>& complete) {
  return findWindow(makeCycles(), complete, kRecord, std::nullopt).value();
}

TEST(FindWindow, TakesTheFirstWholeCycleWithItsLeadIn) {
  const SimulatedWindow window = choose({{0.5, 9}});
  EXPECT_EQ(window.cycle->number, 1);
  EXPECT_NEAR(window.range.start, 1 - kLeadIn, tol(1e-12));
  EXPECT_NEAR(window.range.end, 2 + kLeadOut, tol(1e-12));
  EXPECT_FALSE(window.is_realigned);
  EXPECT_TRUE(window.warning.empty());
}

TEST(FindWindow, SkipsCyclesWithoutForces) {
  EXPECT_EQ(choose({{1.9, 4}}).cycle->number, 2);
}

// From 25 % of a cycle to 25 % of the next.
TEST(FindWindow, RealignsWhereNoCycleIsWhole) {
  const SimulatedWindow window = choose({{1.25 - kLeadIn, 2.25 + kLeadOut}});
  EXPECT_TRUE(window.is_realigned);
  EXPECT_EQ(window.cycle->foot, Foot::kRight);
  EXPECT_EQ(window.cycle->number, 1);
  EXPECT_NEAR(window.range.start, 1.25 - kLeadIn, tol(1e-12));
  EXPECT_NEAR(window.range.end, 2.25 + kLeadOut, tol(1e-12));
}

TEST(FindWindow, CutsTheLeadInWithAWarning) {
  const SimulatedWindow window = choose({{0.99, 2.005}});
  EXPECT_FALSE(window.is_realigned);
  EXPECT_EQ(window.range.start, 0.99);
  EXPECT_FALSE(window.warning.empty());
}

TEST(FindWindow, FallsBackOnTheLongestInterval) {
  const SimulatedWindow window = choose({{1.1, 1.4}, {2.2, 2.9}, {3.2, 3.3}});
  EXPECT_FALSE(window.cycle.has_value());
  EXPECT_EQ(window.range.start, 2.2);
  EXPECT_EQ(window.range.end, 2.9);
  EXPECT_FALSE(window.warning.empty());
  EXPECT_FALSE(findWindow(makeCycles(), {}, kRecord, std::nullopt).has_value());
}

TEST(FindWindow, TakesWhatIsAskedFor) {
  const SimulatedWindow window =
      findWindow(makeCycles(), {{0.5, 2.3}}, kRecord, CycleChoice{Foot::kLeft, 2}).value();
  EXPECT_NEAR(window.range.start, 2.5 - kLeadIn, tol(1e-12));
  EXPECT_FALSE(window.warning.empty());
  EXPECT_THROW(findWindow(makeCycles(), {}, kRecord, CycleChoice{Foot::kLeft, 3}), Error);
}

TEST(ListCycles, NumbersEachFootAndSaysWhatIsComplete) {
  using Kind = GaitEvent::Kind;
  using Source = GaitEvent::Source;
  const std::vector<NumberedCycle> cycles =
      listCycles({{Kind::kFootStrike, Foot::kRight, 1, Source::kForces},
                  {Kind::kToeOff, Foot::kRight, 1.6, Source::kForces},
                  {Kind::kFootStrike, Foot::kRight, 2, Source::kForces},
                  {Kind::kToeOff, Foot::kRight, 2.6, Source::kForces},
                  {Kind::kFootStrike, Foot::kRight, 3, Source::kMarkers}},
                 {{0.9, 2.5}});
  ASSERT_EQ(cycles.size(), 2U);
  EXPECT_EQ(cycles[0].number, 1);
  EXPECT_TRUE(cycles[0].has_complete_forces);
  EXPECT_EQ(cycles[0].source, Source::kForces);
  EXPECT_FALSE(cycles[1].has_complete_forces);
  EXPECT_EQ(cycles[1].source, Source::kMarkers);
}

}  // namespace
}  // namespace gaitmill

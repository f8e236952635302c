#include "core/figure/ticks.h"

#include <limits>

#include <gtest/gtest.h>

namespace gaitmill {
namespace {

TEST(Ticks, AreRoundNumbersWithinTheRange) {
  EXPECT_EQ(makeTicks({0, 100}, 4), (std::vector<double>{0, 25, 50, 75, 100}));
  EXPECT_EQ(makeTicks({-20, 60}, 4), (std::vector<double>{-20, 0, 20, 40, 60}));
}

TEST(Ticks, WearTheDigitsThatTellThemApart) {
  EXPECT_EQ(labelTicks({0, 0.25, 0.5}), (std::vector<std::string>{"0.00", "0.25", "0.50"}));
  EXPECT_EQ(labelTicks({-20, 0, 20}), (std::vector<std::string>{"\u221220", "0", "20"}));
}

TEST(Range, KeepsFixedEndsAndRoundsTheOthers) {
  const Range fixed = findRange({"Activation", "", 0.0, 1.0}, 0.02, 0.7, 5);
  EXPECT_EQ(fixed.low, 0);
  EXPECT_EQ(fixed.high, 1);
  const Range free = findRange({"Moment", "N·m"}, -17, 83, 5);
  EXPECT_EQ(free.low, -20);
  EXPECT_EQ(free.high, 100);
}

TEST(Range, GivesAConstantRoom) {
  const Range range = findRange({"Position", "m"}, 3, 3, 5);
  EXPECT_LT(range.low, 3);
  EXPECT_GT(range.high, 3);
  EXPECT_LT(findRange({"Force", "N"}, 0, 0, 5).low, findRange({"Force", "N"}, 0, 0, 5).high);
}

TEST(DataRange, IgnoresWhatIsNotANumberAndHoldsHorizontalGuides) {
  Panel panel;
  Series series;
  series.x = {0, 1, 2};
  series.y = {1, std::numeric_limits<double>::quiet_NaN(), 2};
  panel.series = {series};
  panel.guides = {{Guide::Direction::kHorizontal, 5, "limit"},
                  {Guide::Direction::kVertical, 100, "toe-off"}};
  EXPECT_EQ(findDataY(panel).low, 1);
  EXPECT_EQ(findDataY(panel).high, 5);
  EXPECT_EQ(findDataX(panel).high, 2);
}

TEST(AxisTitle, HasTheUnitInBrackets) {
  EXPECT_EQ(makeAxisTitle({"Gait cycle", "%"}), "Gait cycle [%]");
  EXPECT_EQ(makeAxisTitle({"Activation", ""}), "Activation");
}

}  // namespace
}  // namespace gaitmill

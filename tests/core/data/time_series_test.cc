#include "core/data/time_series.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

TimeSeries makeRamp() {
  TimeSeries table = makeTimeSeries("ramp", {"a", "b"}, {0.0, 1.0, 3.0});
  table.values << 0, 10, 1, 11, 3, 13;
  return table;
}

TEST(TimeSeries, IsBornNaN) {
  const TimeSeries table = makeTimeSeries("t", {"a"}, {0.0});
  EXPECT_TRUE(std::isnan(table.values(0, 0)));
}

TEST(TimeSeries, UnknownLabelIsAnErrorThatNamesTheNearest) {
  TimeSeries table = makeTimeSeries("t", {"knee_angle_r"}, {0.0});
  try {
    table.getColumn("knee_angel_r");
    FAIL() << "did not throw";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kTableUnknownLabel);
    EXPECT_NE(error.message().find("'knee_angle_r'"), std::string::npos);
  }
}

TEST(TimeSeries, NearestRowTakesTheEarlierOfTwoEquallyNear) {
  const TimeSeries table = makeRamp();
  EXPECT_EQ(table.findNearestRow(-5), 0);
  EXPECT_EQ(table.findNearestRow(0.5), 0);
  EXPECT_EQ(table.findNearestRow(2.1), 2);
  EXPECT_EQ(table.findNearestRow(9), 2);
}

TEST(TimeSeries, InterpolationIsLinearAndHoldsAtTheEnds) {
  const TimeSeries table = makeRamp();
  EXPECT_NEAR(table.interpolate(2.0)(0), 2.0, tol(1e-15));
  EXPECT_NEAR(table.interpolate(-1.0)(1), 10.0, tol(1e-15));
  EXPECT_NEAR(table.interpolate(9.0)(1), 13.0, tol(1e-15));
}

TEST(TimeSeries, CopiedRowsKeepLabelsAndValues) {
  const TimeSeries part = makeRamp().copyRows(1, 2);
  ASSERT_EQ(part.rowCount(), 2);
  EXPECT_EQ(part.time[0], 1.0);
  EXPECT_EQ(part.values(1, 1), 13.0);
}

}  // namespace
}  // namespace gaitmill

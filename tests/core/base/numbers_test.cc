#include "core/base/numbers.h"

#include <limits>

#include <gtest/gtest.h>

namespace gaitmill {
namespace {

TEST(RoundSignificant, KeepsTheLeadingDigits) {
  EXPECT_EQ(roundSignificant(1234.5678, 4), 1235);
  EXPECT_EQ(roundSignificant(-0.0012345678, 4), -0.001235);
  EXPECT_EQ(roundSignificant(0, 4), 0);
  EXPECT_EQ(roundSignificant(9999.9, 4), 10000);
}

TEST(FormatShort, WritesThreeDigitsWithoutIdleZeros) {
  EXPECT_EQ(formatShort(0.012345), "0.0123");
  EXPECT_EQ(formatShort(12.5), "12.5");
  EXPECT_EQ(formatShort(40), "40");
  EXPECT_EQ(formatShort(1234.5), "1230");
  EXPECT_EQ(formatShort(-0.65), "-0.65");
  EXPECT_EQ(formatShort(0), "0");
  EXPECT_EQ(formatShort(std::numeric_limits<double>::quiet_NaN()), "nan");
}

}  // namespace
}  // namespace gaitmill

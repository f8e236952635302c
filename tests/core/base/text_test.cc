#include "core/base/text.h"

#include <limits>

#include <gtest/gtest.h>

namespace gaitmill {
namespace {

TEST(FormatFixed, KeepsTheDecimalsAskedFor) {
  EXPECT_EQ(formatFixed(1.0386, 1), "1.0");
  EXPECT_EQ(formatFixed(-0.5, 3), "-0.500");
  EXPECT_EQ(formatFixed(1234567.0, 0), "1234567");
  EXPECT_EQ(formatFixed(std::numeric_limits<double>::quiet_NaN(), 2), "nan");
}

}  // namespace
}  // namespace gaitmill

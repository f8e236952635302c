#include "core/sample/noise.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

TEST(Noise, HasMeanZeroAndDeviationOne) {
  Noise noise(1);
  const int count = 100000;
  double sum = 0, squares = 0;
  for (int i = 0; i < count; ++i) {
    const double x = noise.draw();
    sum += x;
    squares += x * x;
  }
  // Four standard errors: 4/sqrt(n) of the mean, 4/sqrt(2n) of the deviation.
  EXPECT_NEAR(sum / count, 0, tol(0.0127));
  EXPECT_NEAR(std::sqrt(squares / count), 1, tol(0.009));
}

TEST(Noise, SameSeedGivesTheSameBits) {
  Noise a(7), b(7), c(8);
  const double first = a.draw();
  EXPECT_EQ(first, b.draw());
  EXPECT_NE(first, c.draw());
}

}  // namespace
}  // namespace gaitmill

#include "core/cmc/path_table.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

double cubic(double t) {
  return 0.3 + t * (0.1 - t * (2 - 40 * t));
}
double cubicSlope(double t) {
  return 0.1 - t * (4 - 120 * t);
}

TEST(PathTable, ReproducesACubicFromTwoNodes) {
  PathTable table(2, 3);
  table.start(0.01, 1);
  for (int k = 0; k <= 1; ++k) {
    const double t = 0.01 * k;
    table.setNode(k, Eigen::Vector2d(0, cubic(t)), Eigen::Vector2d(0, cubicSlope(t)));
  }
  for (double t = 0; t <= 0.01; t += 0.0007) {
    EXPECT_NEAR(table.calcLength(1, t), cubic(t), tol(1e-15));
    EXPECT_EQ(table.calcLength(0, t), 0);
  }
}

// h^4 l''''/384 with l'''' = 1e3 m/s^4 and h = 5 ms: 1.6e-9 m.
TEST(PathTable, ErrorOfAFastPathIsNanometres) {
  PathTable table(1, 2);
  table.start(0.005, 2);
  const double rate = std::pow(1e3 / 0.02, 0.25);
  for (int k = 0; k <= 2; ++k) {
    const double t = 0.005 * k;
    table.setNode(k,
                  Eigen::VectorXd::Constant(1, 0.02 * std::sin(rate * t)),
                  Eigen::VectorXd::Constant(1, 0.02 * rate * std::cos(rate * t)));
  }
  for (double t = 0; t <= 0.01; t += 0.0003) {
    EXPECT_NEAR(table.calcLength(0, t), 0.02 * std::sin(rate * t), tol(1.7e-9));
  }
}

}  // namespace
}  // namespace gaitmill

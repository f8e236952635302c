#include "core/math/box_qp.h"

#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(BoxQp, WithoutActiveBoundsItIsTheLinearSystem) {
  BoxQp qp(2);
  Eigen::Matrix2d H;
  H << 4, 1, 1, 3;
  const Eigen::Vector2d g(-1, -2);
  const Eigen::Vector2d bound = Eigen::Vector2d::Constant(kInfinity);
  Eigen::VectorXd x(2);
  ASSERT_TRUE(qp.solve(H, g, -bound, bound, x));
  EXPECT_NEAR(x[0], 1.0 / 11, tol(1e-15));
  EXPECT_NEAR(x[1], 7.0 / 11, tol(1e-15));
}

TEST(BoxQp, IndefiniteHessianIsReported) {
  BoxQp qp(2);
  Eigen::Matrix2d H;
  H << 1, 2, 2, 1;
  const Eigen::Vector2d bound = Eigen::Vector2d::Constant(kInfinity);
  Eigen::VectorXd x(2);
  EXPECT_FALSE(qp.solve(H, Eigen::Vector2d(1, 1), -bound, bound, x));
}

TEST(BoxQp, EqualBoundsFixAnUnknown) {
  BoxQp qp(2);
  const Eigen::Matrix2d H = Eigen::Matrix2d::Identity();
  Eigen::VectorXd x(2);
  ASSERT_TRUE(
      qp.solve(H, Eigen::Vector2d(-1, -1), Eigen::Vector2d(0, -9), Eigen::Vector2d(0, 9), x));
  EXPECT_EQ(x[0], 0.0);
  EXPECT_NEAR(x[1], 1.0, tol(1e-15));
}

TEST(BoxQp, RandomProblemsSatisfyTheOptimalityConditions) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const int n = 12;
  BoxQp qp(n);
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return normal(random); });
    const Eigen::MatrixXd H = A * A.transpose() + 0.01 * Eigen::MatrixXd::Identity(n, n);
    const Eigen::VectorXd g = Eigen::VectorXd::NullaryExpr(n, [&] { return 5 * normal(random); });
    const Eigen::VectorXd upper = Eigen::VectorXd::NullaryExpr(
        n, [&](Eigen::Index i) { return i % 4 == 0 ? 0.0 : std::abs(normal(random)); });
    const Eigen::VectorXd lower = Eigen::VectorXd::NullaryExpr(
        n, [&](Eigen::Index i) { return i % 3 == 0 ? -kInfinity : -std::abs(normal(random)); });
    Eigen::VectorXd x(n);
    ASSERT_TRUE(qp.solve(H, g, lower, upper, x));
    const Eigen::VectorXd slope = H * x + g;
    for (int i = 0; i < n; ++i) {
      EXPECT_GE(x[i], lower[i]);
      EXPECT_LE(x[i], upper[i]);
      if (x[i] > lower[i] && x[i] < upper[i]) {
        EXPECT_NEAR(slope[i], 0.0, tol(1e-9)) << trial;
      } else {
        EXPECT_GE(x[i] <= lower[i] ? slope[i] : -slope[i], -tol(1e-9)) << trial;
      }
    }
  }
}

}  // namespace
}  // namespace gaitmill

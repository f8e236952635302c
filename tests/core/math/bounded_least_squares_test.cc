#include "core/math/bounded_least_squares.h"

#include <limits>
#include <random>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "tests/support/allocation_counter.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Eigen::MatrixXd makeRandom(std::mt19937& random, int rows, int columns) {
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

TEST(BoundedLeastSquares, WithoutBoundsIsPlainLeastSquares) {
  std::mt19937 random(1);
  const Eigen::MatrixXd C = makeRandom(random, 58, 29);
  const Eigen::VectorXd d = makeRandom(random, 58, 1);
  const Eigen::VectorXd far = Eigen::VectorXd::Constant(29, kInfinity);
  BoundedLeastSquares solver(58, 29);
  Eigen::VectorXd x(29);
  const auto report = solver.solve(C, d, -far, far, x);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.factorizations, 1);
  const Eigen::VectorXd expected = C.colPivHouseholderQr().solve(d);
  EXPECT_LE((x - expected).lpNorm<Eigen::Infinity>(), tol(1e-13));
}

TEST(BoundedLeastSquares, SatisfiesTheOptimalityConditions) {
  std::mt19937 random(2);
  BoundedLeastSquares solver(40, 20);
  Eigen::VectorXd x(20);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::MatrixXd C = makeRandom(random, 40, 20);
    const Eigen::VectorXd d = 3 * makeRandom(random, 40, 1);
    const Eigen::VectorXd lower = makeRandom(random, 20, 1) - Eigen::VectorXd::Constant(20, 0.5);
    const Eigen::VectorXd upper = lower + makeRandom(random, 20, 1).cwiseAbs();
    const auto report = solver.solve(C, d, lower, upper, x);
    ASSERT_TRUE(report.converged);
    const Eigen::VectorXd downhill = C.transpose() * (d - C * x);
    for (int j = 0; j < 20; ++j) {
      ASSERT_GE(x(j), lower(j));
      ASSERT_LE(x(j), upper(j));
      if (x(j) < upper(j)) {
        EXPECT_LE(downhill(j), tol(1e-8));
      }
      if (x(j) > lower(j)) {
        EXPECT_GE(downhill(j), -tol(1e-8));
      }
    }
  }
}

TEST(BoundedLeastSquares, DoesNotAllocate) {
  std::mt19937 random(3);
  const Eigen::MatrixXd C = makeRandom(random, 58, 29);
  const Eigen::VectorXd d = makeRandom(random, 58, 1);
  const Eigen::VectorXd near = Eigen::VectorXd::Constant(29, 0.05);
  const Eigen::VectorXd lower = -near;
  BoundedLeastSquares solver(58, 29);
  Eigen::VectorXd x(29);
  EXPECT_EQ(countAllocationsOf([&] { solver.solve(C, d, lower, near, x); }), 0);
}

}  // namespace
}  // namespace gaitmill

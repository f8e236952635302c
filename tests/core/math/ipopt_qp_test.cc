#include "core/math/ipopt_qp.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

TEST(IpoptQp, SharesAForceInTheRatioOfStrengthSquared) {
  QpProblem problem(1, 2);
  problem.A << 1, 1;
  problem.c << 10;
  problem.weight << 1, 0.25;
  Eigen::VectorXd F = Eigen::VectorXd::Zero(2);
  const QpReport report = solveByIpopt(problem, {}, F);
  EXPECT_EQ(report.stop, QpStop::kSolved);
  EXPECT_NEAR(F(0), 2, tol(1e-7));
  EXPECT_NEAR(F(1), 8, tol(1e-7));
}

TEST(IpoptQp, StaysWithinBounds) {
  QpProblem problem(1, 2);
  problem.A << 1, 1;
  problem.c << 10;
  problem.weight << 1, 0.25;
  problem.upper(1) = 5;
  Eigen::VectorXd F = Eigen::VectorXd::Zero(2);
  solveByIpopt(problem, {}, F);
  EXPECT_LE(F(1), 5);
  EXPECT_NEAR(F(0), 5, tol(1e-6));
}

TEST(IpoptQp, RefusesALinearCost) {
  QpProblem problem(1, 1);
  problem.A << 1;
  Eigen::VectorXd F = Eigen::VectorXd::Zero(1);
  EXPECT_THROW(solveByIpopt(problem, {1.0, 1e-8, 10}, F), Error);
}

}  // namespace
}  // namespace gaitmill

#include "core/math/diagonal_qp.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/math/ipopt_qp.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A window as CMC meets it: `muscles` bounded pulls with arms of some centimetres over three rows
// each, which reach most of the demand, then one dear and unbounded torque per row.
QpProblem makeWindow(std::mt19937& random, int rows, int muscles) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  QpProblem problem(rows, muscles + rows);
  for (int j = 0; j < muscles; ++j) {
    for (int k = 0; k < 3; ++k) {
      const int row = static_cast<int>(uniform(random) * rows);
      problem.A(row, j) = 0.04 * normal(random);
    }
    const double strength = 100 + 5000 * uniform(random);
    problem.weight(j) = 1 / (strength * strength);
    problem.lower(j) = 0.1 * strength * uniform(random);
    problem.upper(j) = problem.lower(j) + strength * uniform(random);
  }
  for (int i = 0; i < rows; ++i) {
    problem.A(i, muscles + i) = 1;
    problem.weight(muscles + i) = 1 / (2.5 * 2.5);
    problem.c(i) = 3 * normal(random);
  }
  for (int j = 0; j < muscles; ++j) {
    const double pull =
        problem.lower(j) + (problem.upper(j) - problem.lower(j)) * std::pow(uniform(random), 3);
    problem.c += problem.A.col(j) * pull;
  }
  return problem;
}

// Largest violation of optimality: d cost / dF_j - A_j^T lambda must be zero off the bounds, not
// negative at the lower and not positive at the upper, relative to the gradient's own size.
double calcOptimalityError(const QpProblem& problem,
                           const Eigen::VectorXd& F,
                           const Eigen::VectorXd& multipliers) {
  double worst = 0;
  for (int j = 0; j < problem.columns(); ++j) {
    const double pull = problem.A.col(j).dot(multipliers);
    const double slope = 2 * problem.weight(j) * F(j) - pull;
    const double size = std::sqrt(problem.weight(j)) * 1e-3 + std::abs(pull);
    const bool low = F(j) <= problem.lower(j);
    const bool high = F(j) >= problem.upper(j);
    const double error = low && high ? 0 : low ? -slope : high ? slope : std::abs(slope);
    worst = std::max(worst, error / size);
  }
  return worst;
}

TEST(DiagonalQp, SharesAForceInTheRatioOfStrengthSquared) {
  // Two forces on one row: minimise (F1/1)^2 + (F2/2)^2 with F1 + F2 = 10 gives 2 and 8.
  QpProblem problem(1, 2);
  problem.A << 1, 1;
  problem.c << 10;
  problem.weight << 1, 0.25;
  DiagonalQp solver(1, 2);
  Eigen::VectorXd F(2);
  const QpReport report = solver.solve(problem, F);
  EXPECT_EQ(report.stop, QpStop::kSolved);
  EXPECT_NEAR(F(0), 2, tol(1e-12));
  EXPECT_NEAR(F(1), 8, tol(1e-12));
  EXPECT_NEAR(solver.multipliers()(0), 4, tol(1e-12));
}

TEST(DiagonalQp, PutsTheRestOnTheOthersWhenABoundIsReached) {
  QpProblem problem(1, 2);
  problem.A << 1, 1;
  problem.c << 10;
  problem.weight << 1, 0.25;
  problem.upper(1) = 5;
  DiagonalQp solver(1, 2);
  Eigen::VectorXd F(2);
  solver.solve(problem, F);
  EXPECT_NEAR(F(0), 5, tol(1e-10));
  EXPECT_EQ(F(1), 5);
}

TEST(DiagonalQp, SatisfiesTheOptimalityConditionsOfRandomWindows) {
  std::mt19937 random(1);
  DiagonalQp solver(29, 109);
  Eigen::VectorXd F(109);
  for (int trial = 0; trial < 200; ++trial) {
    const QpProblem problem = makeWindow(random, 29, 80);
    solver.resetWarmStart();
    const QpReport report = solver.solve(problem, F);
    ASSERT_EQ(report.stop, QpStop::kSolved);
    EXPECT_LE(report.iterations, 40);
    EXPECT_LE(report.residual, tol(2e-9)) << trial;
    EXPECT_LE(calcOptimalityError(problem, F, solver.multipliers()), tol(1e-9)) << trial;
  }
}

TEST(DiagonalQp, AgreesWithIpopt) {
  std::mt19937 random(2);
  DiagonalQp solver(29, 109);
  Eigen::VectorXd F(109);
  Eigen::VectorXd by_ipopt(109);
  for (int trial = 0; trial < 5; ++trial) {
    const QpProblem problem = makeWindow(random, 29, 80);
    solver.solve(problem, F);
    by_ipopt.setZero();
    const QpReport report = solveByIpopt(problem, {2, 1e-11, 2000}, by_ipopt);
    ASSERT_EQ(report.stop, QpStop::kSolved);
    const Eigen::ArrayXd price = problem.weight.array().sqrt();
    // Ipopt stays off an active bound by barrier / multiplier.
    EXPECT_LE(((F - by_ipopt).array() * price).abs().maxCoeff(), tol(1e-5));
  }
}

TEST(DiagonalQp, WarmStartOfANearbyProblemTakesFewSteps) {
  std::mt19937 random(3);
  QpProblem problem = makeWindow(random, 29, 80);
  DiagonalQp solver(29, 109);
  Eigen::VectorXd F(109);
  const int cold = solver.solve(problem, F).iterations;
  problem.c *= 1.001;
  const int warm = solver.solve(problem, F).iterations;
  EXPECT_LE(warm, 4);
  EXPECT_LT(warm, cold);
}

TEST(DiagonalQp, DoesNotAllocate) {
  std::mt19937 random(4);
  const QpProblem problem = makeWindow(random, 29, 80);
  DiagonalQp solver(29, 109);
  Eigen::VectorXd F(109);
  EXPECT_EQ(countAllocationsOf([&] { solver.solve(problem, F); }), 0);
}

TEST(DiagonalQp, KeepsFixedForces) {
  std::mt19937 random(5);
  QpProblem problem = makeWindow(random, 29, 80);
  problem.lower(7) = problem.upper(7) = 123;
  DiagonalQp solver(29, 109);
  Eigen::VectorXd F(109);
  EXPECT_EQ(solver.solve(problem, F).stop, QpStop::kSolved);
  EXPECT_EQ(F(7), 123);
}

TEST(DiagonalQp, ReportsTheMissingPartOfAnInfeasibleDemand) {
  // Row 0 can reach 3 at most and is asked for 5; row 1 is free and must not suffer.
  QpProblem problem(2, 3);
  problem.A << 1, 1, 0, 0, 0, 1;
  problem.c << 5, 7;
  problem.lower.setZero();
  problem.upper << 1, 2, kInfinity;
  DiagonalQp solver(2, 3);
  Eigen::VectorXd F(3);
  const QpReport report = solver.solve(problem, F);
  EXPECT_EQ(report.stop, QpStop::kElastic);
  EXPECT_NEAR(solver.slack()(0), 2, tol(1e-7));
  EXPECT_NEAR(solver.slack()(1), 0, tol(1e-6));
  EXPECT_NEAR(F(0), 1, tol(1e-12));
  EXPECT_NEAR(F(1), 2, tol(1e-12));
  EXPECT_NEAR(F(2), 7, tol(1e-6));
}

TEST(DiagonalQp, AnswersInfeasibleWindowsOfAnySize) {
  std::mt19937 random(6);
  DiagonalQp solver(29, 109);
  Eigen::VectorXd F(109);
  for (int trial = 0; trial < 50; ++trial) {
    QpProblem problem = makeWindow(random, 29, 80);
    problem.lower.tail(29).setConstant(-1);  // the torques can give no more than 1 N.m
    problem.upper.tail(29).setConstant(1);
    problem.c *= 10;
    const QpReport report = solver.solve(problem, F);
    ASSERT_EQ(report.stop, QpStop::kElastic) << trial;
    EXPECT_TRUE((F.array() >= problem.lower.array()).all());
    EXPECT_TRUE((F.array() <= problem.upper.array()).all());
    // Optimal violation: no force off its bounds could make it smaller.
    const Eigen::VectorXd scale =
        (problem.A * problem.weight.array().rsqrt().matrix().asDiagonal() * std::sqrt(0.5))
            .rowwise()
            .norm()
            .cwiseInverse();
    const Eigen::VectorXd gradient =
        problem.A.transpose() * scale.cwiseAbs2().cwiseProduct(solver.slack());
    for (int j = 0; j < 109; ++j) {
      const double downhill = gradient(j) / std::sqrt(problem.weight(j));
      if (F(j) < problem.upper(j)) {
        EXPECT_LE(downhill, tol(1e-5)) << trial << " " << j;
      }
      if (F(j) > problem.lower(j)) {
        EXPECT_GE(downhill, -tol(1e-5)) << trial << " " << j;
      }
    }
  }
}

TEST(DiagonalQp, WithoutElasticModeSaysThatItFailed) {
  QpProblem problem(1, 1);
  problem.A << 1;
  problem.c << 5;
  problem.upper << 1;
  DiagonalQpOptions options;
  options.elastic = ElasticMode::kOff;
  DiagonalQp solver(1, 1, options);
  Eigen::VectorXd F(1);
  EXPECT_EQ(solver.solve(problem, F).stop, QpStop::kIterationLimit);
}

class CostExponent : public ::testing::TestWithParam<double> {};

TEST_P(CostExponent, SharesAForceByTheClosedForm) {
  // minimise x1^p + x2^p with F = s x, F1 + F2 = 10: x_j proportional to s_j^(1/(p-1)).
  const double p = GetParam();
  const double s1 = 1;
  const double s2 = 2;
  QpProblem problem(1, 2);
  problem.A << 1, 1;
  problem.c << 10;
  problem.weight << std::pow(s1, -p), std::pow(s2, -p);
  problem.lower.setZero();
  problem.upper.setConstant(100);
  DiagonalQpOptions options;
  options.exponent = p;
  DiagonalQp solver(1, 2, options);
  Eigen::VectorXd F(2);
  ASSERT_EQ(solver.solve(problem, F).stop, QpStop::kSolved);
  const double a = std::pow(s1, p / (p - 1));
  const double b = std::pow(s2, p / (p - 1));
  EXPECT_NEAR(F(0), 10 * a / (a + b), tol(1e-7));
  EXPECT_NEAR(F(1), 10 * b / (a + b), tol(1e-7));
}

TEST_P(CostExponent, AgreesWithIpoptOnAWindow) {
  const double p = GetParam();
  std::mt19937 random(7);
  QpProblem problem = makeWindow(random, 29, 80);
  problem.weight = problem.weight.array().pow(0.5 * p);
  DiagonalQpOptions options;
  options.exponent = p;
  DiagonalQp solver(29, 109, options);
  Eigen::VectorXd F(109);
  Eigen::VectorXd by_ipopt = Eigen::VectorXd::Zero(109);
  const QpReport report = solver.solve(problem, F);
  ASSERT_EQ(report.stop, QpStop::kSolved) << report.iterations;
  ASSERT_EQ(solveByIpopt(problem, {p, 1e-11, 2000}, by_ipopt).stop, QpStop::kSolved);
  const auto cost = [&](const Eigen::VectorXd& force) {
    return (force.array().abs().pow(p) * problem.weight.array()).sum();
  };
  EXPECT_NEAR(cost(F) / cost(by_ipopt), 1, tol(1e-6));
}

INSTANTIATE_TEST_SUITE_P(Powers, CostExponent, ::testing::Values(1.5, 2.0, 3.0, 5.0));

TEST(DiagonalQp, LinearCostUsesTheCheapestForceFirst) {
  QpProblem problem(1, 3);
  problem.A << 1, 1, 1;
  problem.c << 6;
  problem.weight << 1, 0.2, 3;
  problem.lower.setZero();
  problem.upper << 10, 4, 10;
  DiagonalQpOptions options;
  options.exponent = 1;
  DiagonalQp solver(1, 3, options);
  Eigen::VectorXd F(3);
  ASSERT_EQ(solver.solve(problem, F).stop, QpStop::kSolved);
  EXPECT_NEAR(F(0), 2, tol(1e-9));
  EXPECT_NEAR(F(1), 4, tol(1e-9));
  EXPECT_NEAR(F(2), 0, tol(1e-9));
}

// d cost / dF_j with the barrier's terms equals A_j^T lambda, and every force is off its bounds.
TEST(DiagonalQp, BarrierSolutionIsStationaryInsideTheBounds) {
  std::mt19937 random(17);
  QpProblem problem = makeWindow(random, 8, 30);
  problem.upper(3) = problem.lower(3);
  problem.upper(4) = kInfinity;
  DiagonalQpOptions options;
  options.barrier = 1e-5;
  DiagonalQp qp(problem.rows(), problem.columns(), options);
  Eigen::VectorXd F(problem.columns());
  ASSERT_EQ(qp.solve(problem, F).stop, QpStop::kSolved);
  EXPECT_LT(qp.slack().lpNorm<Eigen::Infinity>(), tol(1e-7));
  EXPECT_EQ(F(3), problem.lower(3));
  for (int j = 0; j < problem.columns(); ++j) {
    if (j == 3) continue;
    ASSERT_GT(F(j), problem.lower(j));
    ASSERT_LT(F(j), problem.upper(j));
    const double pull = problem.A.col(j).dot(qp.multipliers());
    const double slope = 2 * problem.weight(j) * F(j) -
                         options.barrier / (F(j) - problem.lower(j)) +
                         options.barrier / (problem.upper(j) - F(j));
    EXPECT_NEAR(slope, pull, tol(1e-6) * std::sqrt(problem.weight(j))) << j;
  }
}

TEST(DiagonalQp, VanishingBarrierGivesTheExactSolution) {
  std::mt19937 random(23);
  const QpProblem problem = makeWindow(random, 8, 30);
  Eigen::VectorXd exact(problem.columns());
  DiagonalQp(problem.rows(), problem.columns()).solve(problem, exact);
  DiagonalQpOptions options;
  options.barrier = 1e-14;
  Eigen::VectorXd F(problem.columns());
  DiagonalQp(problem.rows(), problem.columns(), options).solve(problem, F);
  for (int j = 0; j < problem.columns(); ++j) {
    EXPECT_NEAR(F(j), exact(j), tol(1e-5) / std::sqrt(problem.weight(j))) << j;
  }
}

}  // namespace
}  // namespace gaitmill

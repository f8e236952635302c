#include "core/math/nonlinear_program.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Rosenbrock's valley (1 - x)^2 + 100 (y - x^2)^2: minimum 0 at (1, 1).
class Valley : public NonlinearProgram {
 public:
  double upper_x = kInfinity;
  bool throws = false;
  int evaluations = 0;

  int variableCount() const override { return 2; }
  void getBounds(Eigen::Ref<Eigen::VectorXd> lower,
                 Eigen::Ref<Eigen::VectorXd> upper) const override {
    lower.setConstant(-kInfinity);
    upper << upper_x, kInfinity;
  }
  double calcObjective(const Eigen::Ref<const Eigen::VectorXd>& x) override {
    ++evaluations;
    require(!throws || evaluations < 3, ErrorCode::kInputValue, "enough of this valley");
    return std::pow(1 - x[0], 2) + 100 * std::pow(x[1] - x[0] * x[0], 2);
  }
  void calcGradient(const Eigen::Ref<const Eigen::VectorXd>& x,
                    Eigen::Ref<Eigen::VectorXd> gradient) override {
    const double depth = x[1] - x[0] * x[0];
    gradient << -2 * (1 - x[0]) - 400 * x[0] * depth, 200 * depth;
  }
  std::vector<SparseEntry> hessianPattern() const override { return {{0, 0}, {1, 0}, {1, 1}}; }
  void calcHessian(const Eigen::Ref<const Eigen::VectorXd>& x,
                   double factor,
                   const Eigen::Ref<const Eigen::VectorXd>&,
                   Eigen::Ref<Eigen::VectorXd> values) override {
    values << factor * (2 - 400 * (x[1] - 3 * x[0] * x[0])), factor * -400 * x[0], factor * 200;
  }
};

/// The point of the unit circle that is closest to (2, 1): (2, 1) / sqrt(5).
class Circle : public NonlinearProgram {
 public:
  int variableCount() const override { return 2; }
  int constraintCount() const override { return 1; }
  void getBounds(Eigen::Ref<Eigen::VectorXd> lower,
                 Eigen::Ref<Eigen::VectorXd> upper) const override {
    lower.setConstant(-kInfinity);
    upper.setConstant(kInfinity);
  }
  void getConstraintBounds(Eigen::Ref<Eigen::VectorXd> lower,
                           Eigen::Ref<Eigen::VectorXd> upper) const override {
    lower[0] = upper[0] = 1;
  }
  double calcObjective(const Eigen::Ref<const Eigen::VectorXd>& x) override {
    return 0.5 * (x - target_).squaredNorm();
  }
  void calcGradient(const Eigen::Ref<const Eigen::VectorXd>& x,
                    Eigen::Ref<Eigen::VectorXd> gradient) override {
    gradient = x - target_;
  }
  void calcConstraints(const Eigen::Ref<const Eigen::VectorXd>& x,
                       Eigen::Ref<Eigen::VectorXd> values) override {
    values[0] = x.squaredNorm();
  }
  std::vector<SparseEntry> jacobianPattern() const override { return {{0, 0}, {0, 1}}; }
  void calcJacobian(const Eigen::Ref<const Eigen::VectorXd>& x,
                    Eigen::Ref<Eigen::VectorXd> values) override {
    values = 2 * x;
  }
  std::vector<SparseEntry> hessianPattern() const override { return {{0, 0}, {1, 1}}; }
  void calcHessian(const Eigen::Ref<const Eigen::VectorXd>&,
                   double factor,
                   const Eigen::Ref<const Eigen::VectorXd>& multipliers,
                   Eigen::Ref<Eigen::VectorXd> values) override {
    values.setConstant(factor + 2 * multipliers[0]);
  }

 private:
  Eigen::Vector2d target_{2, 1};
};

TEST(NonlinearProgram, FindsTheBottomOfRosenbrocksValley) {
  Valley valley;
  Eigen::VectorXd x = Eigen::Vector2d(-1.2, 1);
  const NlpReport report = solveNonlinearProgram(valley, {}, {}, x);
  EXPECT_EQ(report.stop, NlpStop::kSolved);
  EXPECT_GT(report.iterations, 5);
  EXPECT_NEAR(report.objective, 0, tol(1e-12));
  EXPECT_NEAR(x[0], 1, tol(1e-6));
  EXPECT_NEAR(x[1], 1, tol(1e-6));
}

// At x <= 0.5 the valley's floor ends at the bound: y = 0.25.
TEST(NonlinearProgram, StopsAtABound) {
  Valley valley;
  valley.upper_x = 0.5;
  Eigen::VectorXd x = Eigen::Vector2d(-1.2, 1);
  const NlpReport report = solveNonlinearProgram(valley, {}, {}, x);
  EXPECT_EQ(report.stop, NlpStop::kSolved);
  EXPECT_LE(x[0], 0.5);
  EXPECT_NEAR(x[0], 0.5, tol(1e-5));
  EXPECT_NEAR(x[1], 0.25, tol(1e-5));
}

TEST(NonlinearProgram, KeepsAConstraint) {
  Circle circle;
  Eigen::VectorXd x = Eigen::Vector2d(0, 1);
  const NlpReport report = solveNonlinearProgram(circle, {}, {}, x);
  EXPECT_EQ(report.stop, NlpStop::kSolved);
  EXPECT_NEAR(x[0], 2 / std::sqrt(5.0), tol(1e-6));
  EXPECT_NEAR(x[1], 1 / std::sqrt(5.0), tol(1e-6));
}

TEST(NonlinearProgram, SaysThatTheIterationsRanOut) {
  Valley valley;
  NlpOptions options;
  options.max_iterations = 2;
  Eigen::VectorXd x = Eigen::Vector2d(-1.2, 1);
  EXPECT_EQ(solveNonlinearProgram(valley, options, {}, x).stop, NlpStop::kIterationLimit);
}

TEST(NonlinearProgram, EndsWhenProgressSaysNo) {
  Valley valley;
  int calls = 0;
  const Progress progress = [&](double) {
    return ++calls < 3;
  };
  Eigen::VectorXd x = Eigen::Vector2d(-1.2, 1);
  try {
    solveNonlinearProgram(valley, {}, progress, x);
    FAIL() << "not cancelled";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCancelled);
  }
  EXPECT_EQ(calls, 3);
}

TEST(NonlinearProgram, PassesOnWhatTheProgramThrows) {
  Valley valley;
  valley.throws = true;
  Eigen::VectorXd x = Eigen::Vector2d(-1.2, 1);
  try {
    solveNonlinearProgram(valley, {}, {}, x);
    FAIL() << "nothing thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInputValue);
  }
}

TEST(NonlinearProgram, GivesTheSameBitsTwice) {
  Valley first, second;
  Eigen::VectorXd x = Eigen::Vector2d(-1.2, 1);
  Eigen::VectorXd y = x;
  solveNonlinearProgram(first, {}, {}, x);
  solveNonlinearProgram(second, {}, {}, y);
  EXPECT_EQ(x, y);
}

}  // namespace
}  // namespace gaitmill

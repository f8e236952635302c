#include "core/math/natural_spline.h"

#include <cmath>
#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

std::vector<double> makeUnevenTimes(int count, double step, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> jitter(0.2, 1.8);
  std::vector<double> time(static_cast<std::size_t>(count));
  double t = 0.45;
  for (double& entry : time) {
    entry = t;
    t += step * jitter(random);
  }
  return time;
}

RowMatrix makeRough(int rows, int columns, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return RowMatrix::NullaryExpr(rows, columns, [&] { return normal(random); });
}

struct Sample {
  Eigen::VectorXd value, first, second;
};

Sample evaluate(const NaturalSpline& spline, double t) {
  const int n = spline.columnCount();
  Sample sample{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  spline.evaluate(t, sample.value, sample.first, sample.second);
  return sample;
}

class BothDegrees : public ::testing::TestWithParam<int> {};

TEST_P(BothDegrees, PassesThroughTheData) {
  const auto time = makeUnevenTimes(40, 0.01, 1);
  const RowMatrix data = makeRough(40, 3, 2);
  const NaturalSpline spline(time, data, GetParam());
  for (int i = 0; i < 40; ++i) {
    const Sample sample = evaluate(spline, time[static_cast<std::size_t>(i)]);
    EXPECT_LE((sample.value - data.row(i).transpose()).lpNorm<Eigen::Infinity>(), tol(1e-14));
  }
}

// The defining property, against a dense solve for the truncated-power form:
//   f(x) = polynomial of degree m-1 + sum_i b_i |x - x_i|^(2m-1), with the b_i free of moments
//   0..m-1.
TEST_P(BothDegrees, AgreesWithTheDenseDefinition) {
  const int degree = GetParam();
  const int m = (degree + 1) / 2;
  const int n = 12;
  const auto time = makeUnevenTimes(n, 1.0, 3);
  const RowMatrix data = makeRough(n, 1, 4);
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + m, n + m);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n + m);
  right.head(n) = data.col(0);
  for (int i = 0; i < n; ++i) {
    const double x = time[static_cast<std::size_t>(i)];
    for (int k = 0; k < n; ++k) {
      system(i, k) = std::pow(std::abs(x - time[static_cast<std::size_t>(k)]), degree);
    }
    for (int k = 0; k < m; ++k) system(i, n + k) = system(n + k, i) = std::pow(x, k);
  }
  const Eigen::VectorXd b = system.fullPivLu().solve(right);
  const NaturalSpline spline(time, data, degree);
  for (double t = time.front() - 1; t < time.back() + 1; t += 0.037) {
    double value = 0;
    double second = 0;
    for (int k = 0; k < n; ++k) {
      const double d = std::abs(t - time[static_cast<std::size_t>(k)]);
      value += b(k) * std::pow(d, degree);
      second += b(k) * degree * (degree - 1) * std::pow(d, degree - 2);
    }
    for (int k = 0; k < m; ++k) value += b(n + k) * std::pow(t, k);
    if (m == 3) second += 2 * b(n + 2);
    const Sample sample = evaluate(spline, t);
    EXPECT_NEAR(sample.value(0), value, tol(1e-9)) << t;
    EXPECT_NEAR(sample.second(0), second, tol(1e-8)) << t;
  }
}

TEST_P(BothDegrees, ReproducesThePolynomialItContinuesWith) {
  const bool quintic = GetParam() == 5;
  const auto time = makeUnevenTimes(30, 0.01, 5);
  RowMatrix data(30, 1);
  const auto f = [&](double t) {
    return 2 - 3 * t + (quintic ? 4 * t * t : 0);
  };
  for (int i = 0; i < 30; ++i) data(i, 0) = f(time[static_cast<std::size_t>(i)]);
  const NaturalSpline spline(time, data, GetParam());
  for (const double t : {0.0, 0.46, 0.6, 1.5}) {
    EXPECT_NEAR(evaluate(spline, t).value(0), f(t), tol(1e-9));
    EXPECT_NEAR(evaluate(spline, t).second(0), quintic ? 8 : 0, tol(1e-7));
  }
}

TEST_P(BothDegrees, DerivativesAreThoseOfTheValue) {
  const auto time = makeUnevenTimes(20, 1.0, 6);
  const NaturalSpline spline(time, makeRough(20, 2, 7), GetParam());
  const double h = 1e-4;
  for (double t = time.front() - 0.5; t < time.back() + 0.5; t += 0.173) {
    const Sample before = evaluate(spline, t - h);
    const Sample here = evaluate(spline, t);
    const Sample after = evaluate(spline, t + h);
    EXPECT_LE(((after.value - before.value) / (2 * h) - here.first).norm(), tol(1e-6));
    EXPECT_LE(((after.first - before.first) / (2 * h) - here.second).norm(), tol(2e-2)) << t;
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, BothDegrees, ::testing::Values(3, 5));

// Rows of a simulation: about 1 ms apart, uneven, here and there a tiny internal step.
TEST(NaturalSpline, SecondDerivativeHoldsOnMillisecondSteps) {
  auto time = makeUnevenTimes(1400, 0.001, 8);
  for (std::size_t i = 100; i < time.size(); i += 100) time[i] = time[i - 1] + 3e-5;
  std::sort(time.begin(), time.end());
  RowMatrix data(1400, 1);
  for (int i = 0; i < 1400; ++i) data(i, 0) = std::sin(7 * time[static_cast<std::size_t>(i)]);
  const NaturalSpline spline(time, data, 5);
  double worst = 0;
  for (std::size_t i = 20; i + 20 < time.size(); ++i) {
    const double exact = -49 * std::sin(7 * time[i]);
    worst = std::max(worst, std::abs(evaluate(spline, time[i]).second(0) - exact));
  }
  // Round-off of the data themselves, 1e-16 / (3e-5 s)^2.
  EXPECT_LE(worst, tol(1.2e-7));
}

TEST(NaturalSpline, EvaluationDoesNotAllocate) {
  const auto time = makeUnevenTimes(50, 0.01, 9);
  const NaturalSpline spline(time, makeRough(50, 39, 10), 5);
  Sample sample = evaluate(spline, 0.6);
  EXPECT_EQ(
      countAllocationsOf([&] { spline.evaluate(0.7, sample.value, sample.first, sample.second); }),
      0);
}

TEST(NaturalSpline, RefusesWhatIsNotATable) {
  const auto code = [](std::vector<double> time, const RowMatrix& values, int degree) {
    try {
      NaturalSpline(std::move(time), values, degree);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::kInternal;
  };
  const std::vector<double> six = {0, 1, 2, 3, 4, 5};
  EXPECT_EQ(code(six, RowMatrix::Zero(6, 1), 4), ErrorCode::kTableShape);
  EXPECT_EQ(code(six, RowMatrix::Zero(5, 1), 5), ErrorCode::kTableShape);
  EXPECT_EQ(code({0, 1, 2, 3, 4}, RowMatrix::Zero(5, 1), 5), ErrorCode::kTableShape);
  EXPECT_EQ(code({0, 1, 2, 2, 4, 5}, RowMatrix::Zero(6, 1), 5), ErrorCode::kTableTimeOrder);
  RowMatrix hole = RowMatrix::Zero(6, 1);
  hole(3, 0) = std::nan("");
  EXPECT_EQ(code(six, hole, 5), ErrorCode::kTableNumber);
}

}  // namespace
}  // namespace gaitmill

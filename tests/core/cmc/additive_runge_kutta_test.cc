#include "core/cmc/additive_runge_kutta.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

using Matrix = std::array<ark::Row, ark::kStages>;

double sum(const ark::Row& row) {
  double total = 0;
  for (const double value : row) {
    total += value;
  }
  return total;
}

ark::Row multiply(const Matrix& A, const ark::Row& x) {
  ark::Row y = {};
  for (std::size_t i = 0; i < ark::kStages; ++i) {
    for (std::size_t j = 0; j < ark::kStages; ++j) {
      y[i] += A[i][j] * x[j];
    }
  }
  return y;
}

double dot(const ark::Row& weights, const ark::Row& x, const ark::Row& y) {
  double total = 0;
  for (std::size_t i = 0; i < ark::kStages; ++i) {
    total += weights[i] * x[i] * y[i];
  }
  return total;
}

constexpr ark::Row kOnes = {1, 1, 1, 1, 1, 1};

TEST(AdditiveRungeKutta, RowsSumToTheNodes) {
  for (std::size_t i = 0; i < ark::kStages; ++i) {
    EXPECT_NEAR(sum(ark::kExplicit[i]), ark::kNodes[i], tol(1e-14)) << i;
    EXPECT_NEAR(sum(ark::kImplicit[i]), ark::kNodes[i], tol(1e-14)) << i;
  }
}

// With common nodes and weights the order conditions of a partitioned method are those of each tree
// with every choice of the two matrices at its inner nodes (Kennedy & Carpenter 2003, table 1).
TEST(AdditiveRungeKutta, WeightsSatisfyAllConditionsOfOrderFour) {
  const ark::Row& b = ark::kWeights;
  const ark::Row& c = ark::kNodes;
  ark::Row c2 = {};
  for (std::size_t i = 0; i < ark::kStages; ++i) {
    c2[i] = c[i] * c[i];
  }
  EXPECT_NEAR(sum(b), 1, tol(1e-14));
  EXPECT_NEAR(dot(b, c, kOnes), 1. / 2, tol(1e-14));
  EXPECT_NEAR(dot(b, c, c), 1. / 3, tol(1e-14));
  EXPECT_NEAR(dot(b, c2, c), 1. / 4, tol(1e-14));
  for (const Matrix* A : {&ark::kExplicit, &ark::kImplicit}) {
    EXPECT_NEAR(dot(b, multiply(*A, c), kOnes), 1. / 6, tol(1e-14));
    EXPECT_NEAR(dot(b, multiply(*A, c), c), 1. / 8, tol(1e-14));
    EXPECT_NEAR(dot(b, multiply(*A, c2), kOnes), 1. / 12, tol(1e-14));
    for (const Matrix* B : {&ark::kExplicit, &ark::kImplicit}) {
      EXPECT_NEAR(dot(b, multiply(*A, multiply(*B, c)), kOnes), 1. / 24, tol(1e-14));
    }
  }
}

TEST(AdditiveRungeKutta, EmbeddedWeightsHaveOrderThreeAndNotFour) {
  const ark::Row& b = ark::kEmbedded;
  const ark::Row& c = ark::kNodes;
  EXPECT_NEAR(sum(b), 1, tol(1e-14));
  EXPECT_NEAR(dot(b, c, kOnes), 1. / 2, tol(1e-14));
  EXPECT_NEAR(dot(b, c, c), 1. / 3, tol(1e-14));
  for (const Matrix* A : {&ark::kExplicit, &ark::kImplicit}) {
    EXPECT_NEAR(dot(b, multiply(*A, c), kOnes), 1. / 6, tol(1e-14));
  }
  EXPECT_GT(std::abs(dot(b, multiply(ark::kImplicit, c), c) - 1. / 8), 1e-5);
}

// Stiff limit: for z -> -infinity one step of the implicit method leaves nothing.
TEST(AdditiveRungeKutta, ImplicitMethodIsStifflyAccurate) {
  for (std::size_t j = 0; j < ark::kStages; ++j) {
    EXPECT_EQ(ark::kImplicit[ark::kStages - 1][j], ark::kWeights[j]);
  }
}

}  // namespace
}  // namespace gaitmill

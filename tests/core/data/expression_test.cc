#include "core/data/expression.h"

#include <array>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/allocation_counter.h"

namespace gaitmill {
namespace {

double evaluate(const std::string& text, double q = 0, double qdot = 0) {
  const std::array<double, 2> values = {q, qdot};
  return Expression(text, {"q", "qdot"}).evaluate(values.data());
}

TEST(Expression, FollowsTheRulesOfAlgebra) {
  EXPECT_EQ(evaluate("1 + 2 * 3"), 7);
  EXPECT_EQ(evaluate("(1 + 2) * 3"), 9);
  EXPECT_EQ(evaluate("8 - 3 - 2"), 3);
  EXPECT_EQ(evaluate("8 / 4 / 2"), 1);
  EXPECT_EQ(evaluate("2 ^ 3 ^ 2"), 512);
  EXPECT_EQ(evaluate("-2 ^ 2"), -4);
  EXPECT_EQ(evaluate("2 ^ -1"), 0.5);
  EXPECT_EQ(evaluate("--3"), 3);
  EXPECT_EQ(evaluate("2*-3"), -6);
  EXPECT_EQ(evaluate(" 1.5e2 "), 150);
}

TEST(Expression, KnowsItsVariablesAndFunctions) {
  EXPECT_EQ(evaluate("-10*q^3 - 0.5*qdot", 2, 4), -82);
  EXPECT_DOUBLE_EQ(evaluate("exp(-(q-1)) + log(q)", 2), std::exp(-1.0) + std::log(2.0));
  EXPECT_EQ(evaluate("step(q-1)*10", 2), 10);
  EXPECT_EQ(evaluate("step(q-1)*10", 0.5), 0);
  EXPECT_EQ(evaluate("min(q, max(qdot, 3))", 5, 1), 3);
  EXPECT_EQ(evaluate("select(step(q), abs(qdot), square(qdot))", -1, -3), 9);
  EXPECT_EQ(evaluate("atan2(q, qdot)", 1, 1), std::atan2(1, 1));
}

// As in the documents of OpenSim: names are defined behind semicolons, in any order.
TEST(Expression, DefinitionsStandBehindSemicolons) {
  EXPECT_EQ(evaluate("k*x; k = 3; x = q - rest; rest = 1", 5), 12);
}

TEST(Expression, ErrorsSayWhatAndWhere) {
  const auto messageOf = [](const std::string& text) -> std::string {
    try {
      evaluate(text);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kModelValue);
      return error.message();
    }
    return "none";
  };
  EXPECT_EQ(messageOf("2 *"), "expression '2 *': expected a value at character 4");
  EXPECT_EQ(messageOf("2 $ 3"), "expression '2 $ 3': did not expect '$' at character 3");
  EXPECT_EQ(messageOf("(1 + 2"), "expression '(1 + 2': expected ')' at character 7");
  EXPECT_EQ(messageOf("p + 1"),
            "expression 'p + 1': 'p' is none of the variables q, qdot at character 1");
  EXPECT_EQ(messageOf("sinc(q)"),
            "expression 'sinc(q)': there is no function 'sinc' at character 1");
  EXPECT_EQ(messageOf("max(q)"), "expression 'max(q)': expected ',' at character 6");
  EXPECT_NE(messageOf(""), "none");
  EXPECT_NE(messageOf("q q"), "none");
}

TEST(Expression, NestingLengthAndGrowthAreBounded) {
  EXPECT_THROW(evaluate(std::string(500, '(') + "1" + std::string(500, ')')), Error);
  EXPECT_THROW(evaluate(std::string(3000, '1')), Error);
  EXPECT_THROW(evaluate("a; a = a"), Error);
  std::string doubling = "x20; x0 = q + q";
  for (int i = 1; i <= 20; ++i) {
    const std::string last = "x" + std::to_string(i - 1);
    doubling += "; x" + std::to_string(i) + " = " + last + " + " + last;
  }
  EXPECT_THROW(evaluate(doubling), Error);
}

TEST(Expression, EvaluatesWithoutAllocating) {
  const Expression expression("-10*q^3 - 0.5*qdot*exp(q)", {"q", "qdot"});
  const std::array<double, 2> values = {0.1, 0.2};
  double result = 0;
  EXPECT_EQ(countAllocationsOf([&] { result = expression.evaluate(values.data()); }), 0);
  EXPECT_LT(result, 0);
}

}  // namespace
}  // namespace gaitmill

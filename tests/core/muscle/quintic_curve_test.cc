#include "core/muscle/quintic_curve.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

QuinticCurve makeCorner() {
  return QuinticCurve({{0, 0, 0}, {1, 1, 3}}, {0.6});
}

TEST(QuinticCurve, PassesItsJointsWithTheirSlopes) {
  const QuinticCurve curve = makeCorner();
  EXPECT_NEAR(curve.calc(0).value, 0, tol(2e-14));
  EXPECT_NEAR(curve.calc(0).slope, 0, tol(2e-12));
  EXPECT_DOUBLE_EQ(curve.calc(1).value, 1);
  EXPECT_DOUBLE_EQ(curve.calc(1).slope, 3);
}

TEST(QuinticCurve, ContinuesStraightBeyondItsEnds) {
  const QuinticCurve curve = makeCorner();
  EXPECT_DOUBLE_EQ(curve.calc(-2).value, 0);
  EXPECT_DOUBLE_EQ(curve.calc(1.5).value, 2.5);
  EXPECT_DOUBLE_EQ(curve.calc(1.5).slope, 3);
}

TEST(QuinticCurve, CellsAgreeWithTheSolvedCurve) {
  for (const double tightness : {0.1, 0.5, 0.9}) {
    const QuinticCurve curve({{0, 0, 0}, {1, 1, 3}}, {tightness});
    for (double x = 0; x < 1; x += 0.00137) {
      const CurvePoint solved = curve.calcBySolving(x);
      EXPECT_NEAR(curve.calc(x).value, solved.value, tol(3e-14)) << x;
      EXPECT_NEAR(curve.calc(x).slope, solved.slope, tol(2e-11)) << x;
    }
  }
}

TEST(QuinticCurve, SlopeIsTheDerivativeOfTheValue) {
  const QuinticCurve curve = makeCorner();
  const double h = 1e-6;
  for (double x = 0.01; x < 0.99; x += 0.007) {
    const double difference = (curve.calc(x + h).value - curve.calc(x - h).value) / (2 * h);
    // Round-off of two values of size 1, some 4e-15, over 2e-6.
    EXPECT_NEAR(curve.calc(x).slope, difference, tol(4e-9)) << "at " << x;
  }
}

TEST(QuinticCurve, InverseOfTheInverseIsTheCurve) {
  const QuinticCurve curve({{0, 0, 0.5}, {1, 1, 3}}, {0.6});
  const QuinticCurve inverse = curve.makeInverse();
  for (double x = -0.5; x < 1.5; x += 0.0137) {
    EXPECT_NEAR(inverse.calc(curve.calc(x).value).value, x, tol(1e-14)) << "at " << x;
  }
}

TEST(QuinticCurve, NotANumberGoesThrough) {
  EXPECT_TRUE(std::isnan(makeCorner().calc(std::numeric_limits<double>::quiet_NaN()).value));
}

TEST(QuinticCurve, RefusesAnSShapedCorner) {
  EXPECT_THROW(QuinticCurve({{0, 0, 0}, {1, 1, 0.5}}, {0.5}), Error);
}

}  // namespace
}  // namespace gaitmill

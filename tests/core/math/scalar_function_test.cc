#include "core/math/scalar_function.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

const std::vector<double> kKneeAngles = {0,
                                         0.174533,
                                         0.349066,
                                         0.523599,
                                         0.698132,
                                         0.872665,
                                         1.0472,
                                         1.22173,
                                         1.39626,
                                         1.5708,
                                         1.74533,
                                         1.91986,
                                         2.0944};

FunctionSpec makePatellaRotation() {
  return {FunctionSpec::Kind::kSimmSpline,
          kKneeAngles,
          {0.00113686,
           -0.00629212,
           -0.105582,
           -0.253683,
           -0.414245,
           -0.579047,
           -0.747244,
           -0.91799,
           -1.09044,
           -1.26379,
           -1.43763,
           -1.61186,
           -1.78634},
          1.0};
}

// Values and slopes printed in spec/rajagopal2016.md 5, inside, at knots and on both
// extrapolations.
TEST(ScalarFunction, SimmSplineMatchesPublishedChecks) {
  struct Check {
    double x, value, slope;
  };
  const ScalarFunction f(makePatellaRotation());
  for (const Check& c : std::vector<Check>{{-0.2, -0.0594163541863, 0.302766070932},
                                           {0, 0.00113686, 0.302766070932},
                                           {0.05, 0.0109085069645, 0.0914736674642},
                                           {0.8, -0.509976344061, -0.946218710911},
                                           {1.3, -0.995169775405, -0.987925691147},
                                           {2.05, -1.7419412371, -0.999891534354},
                                           {2.3, -1.99194893747, -1.00004347016}}) {
    EXPECT_NEAR(f.evaluate(c.x).value, c.value, tol(1e-11)) << c.x;
    EXPECT_NEAR(f.evaluate(c.x).first, c.slope, tol(1e-11)) << c.x;
  }
}

TEST(ScalarFunction, SimmSplineExtrapolatesWithoutCurvature) {
  const ScalarFunction f(makePatellaRotation());
  EXPECT_EQ(f.evaluate(-0.1).second, 0.0);
  EXPECT_EQ(f.evaluate(2.2).second, 0.0);
  EXPECT_NE(f.evaluate(0.01).second, 0.0);
}

TEST(ScalarFunction, DerivativesAreThoseOfTheValue) {
  const ScalarFunction f(makePatellaRotation());
  constexpr double h = 1e-5;
  for (double x = -0.05; x < 2.2; x += 0.0137) {
    const double slope = (f.evaluate(x + h).value - f.evaluate(x - h).value) / (2 * h);
    EXPECT_NEAR(f.evaluate(x).first, slope, tol(1e-7))
        << x;  // truncation h^2 f'''/6 with f''' < 1e3
  }
}

TEST(ScalarFunction, ThreeKnotsGiveAParabola) {
  const ScalarFunction f({FunctionSpec::Kind::kSimmSpline, {0, 1, 3}, {0, 1, 9}, 1.0});
  EXPECT_NEAR(f.evaluate(2).value, 4.0, tol(1e-14));
  EXPECT_NEAR(f.evaluate(0.5).second, 2.0, tol(1e-14));
}

TEST(ScalarFunction, TwoKnotsGiveALine) {
  const ScalarFunction f({FunctionSpec::Kind::kSimmSpline, {0, 2}, {1, 5}, 1.0});
  EXPECT_NEAR(f.evaluate(7).value, 15.0, tol(1e-14));
}

TEST(ScalarFunction, LinearPolynomialAndConstantFollowTheirCoefficientsAndScale) {
  EXPECT_NEAR(ScalarFunction({FunctionSpec::Kind::kLinear, {}, {2, 3}, 0.5}).evaluate(4).value,
              5.5,
              tol(0));
  const ScalarFunction::Sample s =
      ScalarFunction({FunctionSpec::Kind::kPolynomial, {}, {1, 0, -2}, 1.0}).evaluate(3);
  EXPECT_EQ(s.value, 7.0);
  EXPECT_EQ(s.first, 6.0);
  EXPECT_EQ(s.second, 2.0);
  EXPECT_EQ(ScalarFunction({FunctionSpec::Kind::kConstant, {}, {4}, 2.0}).evaluate(9).value, 8.0);
}

TEST(ScalarFunction, UnusableKnotsAreRefused) {
  EXPECT_THROW(ScalarFunction({FunctionSpec::Kind::kSimmSpline, {0, 0}, {1, 2}, 1.0}), Error);
  EXPECT_THROW(ScalarFunction({FunctionSpec::Kind::kSimmSpline, {0, 1}, {1}, 1.0}), Error);
  EXPECT_THROW(ScalarFunction({FunctionSpec::Kind::kSimmSpline, {0, 1}, {1, std::nan("")}, 1.0}),
               Error);
  EXPECT_THROW(ScalarFunction({FunctionSpec::Kind::kLinear, {}, {1}, 1.0}), Error);
}

}  // namespace
}  // namespace gaitmill

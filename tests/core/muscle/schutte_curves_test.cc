#include "core/muscle/schutte_curves.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

// The class's own form: the root of a quadratic in the velocity for the force y = A fV + beta v.
double solveQuadratic(double y, double A, double beta) {
  constexpr double kv = 0.15;
  constexpr double slope_k = 0.13;
  constexpr double f_max = 1.4;
  if (y < -beta) {
    return y / beta;
  }
  if (y < A) {
    const double c = kv * (y - A) / beta;
    const double b = -(y + kv * A + kv * beta) / beta;
    return (-b - std::sqrt(b * b - 4 * c)) / 2;
  }
  const double s = slope_k * kv / (kv + 1);
  const double c = -s * (y - A) / beta;
  const double b = -(y / beta - f_max * A / beta - s);
  return (-b + std::sqrt(b * b - 4 * c)) / 2;
}

TEST(SchutteCurves, ForceVelocityWithDampingIsThePublishedQuadratic) {
  const SchutteCurves curves{SchutteCurvesSpec{}};
  constexpr double beta = 0.1;
  for (const double A : {0.01, 0.4, 1.0}) {
    for (double v = -1.5; v < 1.5; v += 0.0313) {
      const double y = A * curves.calcForceVelocity(v, 1).value + beta * v;
      EXPECT_NEAR(solveQuadratic(y, A, beta), v, tol(1e-12)) << v << " at " << A;
    }
  }
}

TEST(SchutteCurves, ForceVelocityPassesItsCornersAndRises) {
  const SchutteCurves curves{SchutteCurvesSpec{}};
  EXPECT_EQ(curves.calcForceVelocity(-1, 1).value, 0);
  EXPECT_EQ(curves.calcForceVelocity(-2, 1).value, 0);
  EXPECT_EQ(curves.calcForceVelocity(0, 1).value, 1);
  EXPECT_NEAR(curves.calcForceVelocity(1e9, 1).value, 1.4, tol(1e-9));
  // Slopes at rest are in the ratio (f_max - 1)/0.13.
  EXPECT_NEAR(curves.calcForceVelocity(1e-12, 1).slope / curves.calcForceVelocity(-1e-12, 1).slope,
              0.4 / 0.13,
              tol(1e-6));
  double before = -1;
  for (double v = -0.999; v < 3; v += 0.001) {
    const double force = curves.calcForceVelocity(v, 0.3).value;
    EXPECT_GT(force, before) << v;
    EXPECT_NEAR(curves.guessVelocity(force, 0.3), std::min(v, 1.0), tol(1e-12));
    before = force;
  }
}

TEST(SchutteCurves, DefaultCurvesPassTheirKnots) {
  const SchutteCurves curves{SchutteCurvesSpec{}};
  EXPECT_NEAR(curves.calcActive(0.62875).value, 0.636667, tol(1e-15));
  EXPECT_NEAR(curves.calcActive(1.045).value, 0.993333, tol(1e-15));
  EXPECT_NEAR(curves.calcActive(1.43875).value, 0.246667, tol(1e-15));
  EXPECT_NEAR(curves.calcTendon(1.00281).value, 0.0257, tol(1e-12));
  EXPECT_NEAR(curves.calcTendon(1.0123).value, 0.227, tol(1e-12));
  EXPECT_EQ(curves.calcTendon(0.9995).value, 0);
  // Passive force 1 at 1.5 optimal lengths, and a little at every length.
  EXPECT_EQ(curves.calcPassive(1.5).value, 1);
  EXPECT_NEAR(curves.calcPassive(1.0).value, std::exp(-4.0), tol(1e-16));
  EXPECT_NEAR(curves.calcPassive(1.2).slope, 8 * curves.calcPassive(1.2).value, tol(1e-15));
}

TEST(SchutteCurves, ForcesStayPositiveAndElasticOnesRise) {
  const SchutteCurves curves{SchutteCurvesSpec{}};
  for (double l = 0.2; l < 2; l += 0.005) {
    EXPECT_GT(curves.calcActive(l).value, 0) << l;
    EXPECT_GT(curves.calcPassive(l).slope, 0) << l;
  }
  for (double strain = 1e-4; strain < 0.1; strain += 1e-4) {
    EXPECT_GT(curves.calcTendon(1 + strain).slope, 0) << strain;
  }
}

TEST(SchutteCurves, StatedCurvesTakeThePlaceOfTheDefaults) {
  SchutteCurvesSpec spec;
  spec.active_force_length = FunctionSpec{FunctionSpec::Kind::kLinear, {}, {-1, 1.5}, 1};
  spec.passive_force_length = FunctionSpec{FunctionSpec::Kind::kLinear, {}, {0.5, 0}, 1};
  spec.tendon_force_strain = FunctionSpec{FunctionSpec::Kind::kLinear, {}, {30, 0}, 1};
  const SchutteCurves curves(spec);
  EXPECT_NEAR(curves.calcActive(1.2).value, 0.3, tol(1e-15));
  EXPECT_EQ(curves.calcActive(1.7).value, 0) << "the active force is never negative";
  EXPECT_EQ(curves.calcPassive(1.2).value, 0.6);
  EXPECT_NEAR(curves.calcTendon(1.02).value, 0.6, tol(1e-14));
  EXPECT_NEAR(curves.calcTendon(1.02).slope, 30, tol(1e-14));
}

}  // namespace
}  // namespace gaitmill

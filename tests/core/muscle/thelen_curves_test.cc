#include "core/muscle/thelen_curves.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

// Parameters of the class, and those that gait2392 and Hamner's model state.
ThelenCurvesSpec makeDelpLineage() {
  return {0.033, 0.6, 0.5, 4, 0.3, 1.8, 0.95};
}

// Velocity of the force y = a fAL fV at A = a fAL, as spec/muscle.md 10 states it.
double calcVelocityOfForce(const ThelenCurvesSpec& s, double y, double A, double a) {
  const double k = 0.25 + 0.75 * a;
  const auto b = [&](double force) {
    return force <= A ? A + force / s.velocity_shape
                      : (2 + 2 / s.velocity_shape) * (A * s.max_eccentric_force - force) /
                            (s.max_eccentric_force - 1);
  };
  const double limit = 0.95 * A * s.max_eccentric_force;
  if (y > 0 && y < limit) {
    return k * (y - A) / b(y);
  }
  const double y0 = y <= 0 ? 0 : limit;
  const double slope_b =
      y <= 0 ? 1 / s.velocity_shape : -(2 + 2 / s.velocity_shape) / (s.max_eccentric_force - 1);
  return k * (y0 - A) / b(y0) + (k / b(y0) - k * (y0 - A) * slope_b / (b(y0) * b(y0))) * (y - y0);
}

TEST(ThelenCurves, TendonHasItsToeAndForceOneAtItsStrain) {
  for (const ThelenCurvesSpec& spec : {ThelenCurvesSpec{}, makeDelpLineage()}) {
    const ThelenCurves curves(spec);
    const double e0 = spec.tendon_strain_at_one_force;
    const double e3 = std::exp(3.0);
    const double toe = 99 * e0 * e3 / (166 * e3 - 67);
    EXPECT_NEAR(curves.calcTendon(1 + e0).value, 1, tol(1e-14));
    EXPECT_NEAR(curves.calcTendon(1 + toe).value, 0.33, tol(1e-14));
    EXPECT_NEAR(
        curves.calcTendon(1 + 0.5 * toe).value, 0.33 * (std::exp(1.5) - 1) / (e3 - 1), tol(1e-14));
    // The toe's end was chosen so that the line is its tangent.
    EXPECT_NEAR(curves.calcTendon(1 + toe * (1 - 1e-12)).slope,
                curves.calcTendon(1 + toe * (1 + 1e-12)).slope,
                tol(1e-9));
    EXPECT_EQ(curves.calcTendon(1).value, 0);
    EXPECT_EQ(curves.calcTendon(0.9).value, 0);
    EXPECT_EQ(curves.calcTendon(0.9).slope, 0);
  }
}

TEST(ThelenCurves, FiberForceLengthMatchesItsFormulas) {
  const ThelenCurvesSpec spec = makeDelpLineage();
  const ThelenCurves curves(spec);
  for (const double l : {0.3, 0.7, 1.0, 1.2, 1.55, 1.9}) {
    EXPECT_NEAR(curves.calcActive(l).value, std::exp(-(l - 1) * (l - 1) / 0.5), tol(1e-15));
    const double passive = l > 1 ? (std::exp(4 * (l - 1) / 0.6) - 1) / (std::exp(4.0) - 1) : 0.0;
    EXPECT_NEAR(curves.calcPassive(l).value, passive, tol(1e-14));
  }
  EXPECT_NEAR(curves.calcPassive(1.6).value, 1, tol(1e-14));
}

TEST(ThelenCurves, ForceVelocityInvertsTheStatedRelation) {
  for (const ThelenCurvesSpec& spec : {ThelenCurvesSpec{}, makeDelpLineage()}) {
    const ThelenCurves curves(spec);
    for (const double a : {0.01, 0.3, 1.0}) {
      for (double v = -2.5; v < 2.5; v += 0.0371) {
        const double force = curves.calcForceVelocity(v, a).value;
        EXPECT_NEAR(curves.guessVelocity(force, a), v, tol(1e-13)) << v << " at " << a;
        // The relation scales with A: any one will do.
        const double A = a * 0.7;
        EXPECT_NEAR(calcVelocityOfForce(spec, A * force, A, a), v, tol(1e-12)) << v << " at " << a;
      }
      EXPECT_EQ(curves.calcForceVelocity(0, a).value, 1);
    }
  }
}

TEST(ThelenCurves, ForceVelocityRisesEverywhere) {
  const ThelenCurves curves(makeDelpLineage());
  for (const double a : {0.01, 0.5, 1.0}) {
    double before = curves.calcForceVelocity(-5, a).value;
    for (double v = -4.99; v < 5; v += 0.01) {
      const double force = curves.calcForceVelocity(v, a).value;
      EXPECT_GT(force, before) << v;
      before = force;
    }
  }
}

TEST(ThelenCurves, SlopesAreDerivatives) {
  const ThelenCurves curves(makeDelpLineage());
  constexpr double h = 1e-6;
  for (double x = 0.413; x < 1.8; x += 0.0173) {
    const auto difference = [&](auto&& curve) {
      return (curve(x + h).value - curve(x - h).value) / (2 * h);
    };
    const auto active = [&](double l) {
      return curves.calcActive(l);
    };
    const auto passive = [&](double l) {
      return curves.calcPassive(l);
    };
    const auto tendon = [&](double l) {
      return curves.calcTendon(1 + 0.03 * l);
    };
    const auto velocity = [&](double v) {
      return curves.calcForceVelocity(2 * (v - 1.1), 0.4);
    };
    EXPECT_NEAR(active(x).slope, difference(active), tol(1e-8)) << x;
    EXPECT_NEAR(passive(x).slope, difference(passive), tol(1e-7)) << x;
    EXPECT_NEAR(0.03 * tendon(x).slope, difference(tendon), tol(1e-8)) << x;
    EXPECT_NEAR(2 * velocity(x).slope, difference(velocity), tol(1e-5)) << x;
  }
}

TEST(ThelenCurves, ParametersOutOfRangeAreNamed) {
  const auto codeOf = [](double ThelenCurvesSpec::*field, double value) {
    ThelenCurvesSpec spec;
    spec.*field = value;
    try {
      const ThelenCurves curves(spec);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::kInternal;
  };
  EXPECT_EQ(codeOf(&ThelenCurvesSpec::tendon_strain_at_one_force, 0), ErrorCode::kMuscleParameter);
  EXPECT_EQ(codeOf(&ThelenCurvesSpec::passive_strain_at_one_force, 0), ErrorCode::kMuscleParameter);
  EXPECT_EQ(codeOf(&ThelenCurvesSpec::active_shape, -1), ErrorCode::kMuscleParameter);
  EXPECT_EQ(codeOf(&ThelenCurvesSpec::passive_shape, 0), ErrorCode::kMuscleParameter);
  EXPECT_EQ(codeOf(&ThelenCurvesSpec::velocity_shape, 0), ErrorCode::kMuscleParameter);
  EXPECT_EQ(codeOf(&ThelenCurvesSpec::max_eccentric_force, 1), ErrorCode::kMuscleParameter);
  EXPECT_EQ(codeOf(&ThelenCurvesSpec::linear_above_force, 0.7), ErrorCode::kMuscleParameter);
  EXPECT_EQ(codeOf(&ThelenCurvesSpec::linear_above_force, 1), ErrorCode::kMuscleParameter);
}

}  // namespace
}  // namespace gaitmill

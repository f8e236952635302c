#include "core/muscle/muscle_curves.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

struct TablePoint {
  double x;
  double y;
  double slope;
};
#include "tests/core/muscle/curve_tables.inc"

// The tables print twelve significant digits.
void expectTable(const QuinticCurve& curve, const std::vector<TablePoint>& table) {
  for (const TablePoint& point : table) {
    const CurvePoint at = curve.calc(point.x);
    EXPECT_NEAR(at.value, point.y, tol(6e-12 * std::max(1e-1, std::abs(point.y)))) << point.x;
    EXPECT_NEAR(at.slope, point.slope, tol(6e-12 * std::max(1.0, std::abs(point.slope))))
        << "slope at " << point.x;
  }
}

// Geometry of the class defaults of the curve, not of Rajagopal2016.
MuscleCurvesSpec makeClassDefault() {
  MuscleCurvesSpec spec;
  spec.active_min_length = 0.47 - 0.0259;
  spec.active_transition_length = 0.73;
  spec.active_max_length = 1.8123;
  spec.active_shallow_slope = 0.8616;
  return spec;
}

TEST(MuscleCurves, ActiveForceLengthOfClassDefaultMatchesTable) {
  expectTable(makeActiveForceLength(makeClassDefault(), 0.1), kActiveDefault);
  expectTable(makeActiveForceLength(makeClassDefault(), 0.0), kActiveDefaultZero);
}

TEST(MuscleCurves, CurvesOfRajagopal2016MatchTables) {
  const MuscleCurves curves{MuscleCurvesSpec{}};
  expectTable(curves.active_force_length, kActiveRajagopal);
  expectTable(curves.force_velocity, kForceVelocity);
  expectTable(curves.inverse_force_velocity, kInverseMuscle);
  expectTable(curves.passive_force_length, kPassive);
}

// The table prints the end of the toe, 1.037121212, one digit short: its slope is still exact.
TEST(MuscleCurves, TendonCurveMatchesTable) {
  std::vector<TablePoint> table = kTendon;
  for (TablePoint& point : table) {
    if (point.x == 1.037121212) {
      point.x = 1 + 0.049 + (2.0 / 3.0 - 1) / (1.375 / 0.049);
    }
  }
  expectTable(makeTendonForceLength(MuscleCurvesSpec{}), table);
}

TEST(MuscleCurves, InverseForceVelocityOfClassDefaultMatchesTable) {
  expectTable(makeForceVelocity(MuscleCurvesSpec{}, {0.1, 0.1}).makeInverse(), kInverseDefault);
}

TEST(MuscleCurves, EndSlopesAndMinimumOfTheDocumentAreIgnored) {
  MuscleCurvesSpec spec;
  spec.active_minimum_value = 0.1;
  spec.concentric_slope_at_vmax = 0.1;
  const MuscleCurves curves(spec);
  EXPECT_EQ(curves.active_force_length.calc(0.1).value, 0);
  EXPECT_EQ(curves.force_velocity.calc(-2).value, 0);
}

TEST(MuscleCurves, RefuseParametersOutOfRange) {
  MuscleCurvesSpec spec;
  spec.active_transition_length = 1.2;
  EXPECT_THROW(MuscleCurves{spec}, Error);
  spec = MuscleCurvesSpec{};
  spec.tendon_stiffness_at_one_force = 1;
  EXPECT_THROW(MuscleCurves{spec}, Error);
}

}  // namespace
}  // namespace gaitmill

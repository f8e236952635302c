#include "core/rra/rra_limits.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

TimeSeries makeErrors() {
  TimeSeries errors = makeTimeSeries("e", {"knee", "pelvis_tx"}, {0.0, 1.0});
  errors.units = {"rad", "m"};
  errors.values << 0.03, 0.03, -0.04, 0.01;
  return errors;
}

RraPassResult makePass() {
  RraPassResult pass;
  const ResidualSum none{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  pass.residuals = {none, none, none};
  return pass;
}

TEST(RraLimits, DeviationsHaveRmsPeakAndTheLargerShare) {
  const RraLimits limits;
  const auto deviations = calcDeviations(makeErrors(), limits);
  ASSERT_EQ(deviations.size(), 2U);
  EXPECT_EQ(deviations[0].coordinate, "knee");
  EXPECT_FALSE(deviations[0].translation);
  EXPECT_NEAR(deviations[0].rms, std::sqrt(0.0025 / 2), tol(1e-15));
  EXPECT_EQ(deviations[0].peak, 0.04);
  // 2.03 of 2 deg RMS, 2.3 of 5 deg at most
  EXPECT_NEAR(deviations[0].share, toDegrees(std::sqrt(0.0025 / 2)) / 2, tol(1e-12));
  EXPECT_TRUE(deviations[1].translation);
  EXPECT_NEAR(deviations[1].share, std::sqrt(0.001 / 2) / 0.02, tol(1e-12));
}

TEST(RraLimits, MeritSumsWhatExceedsAndNothingElse) {
  const RraLimits limits;
  RraPassResult pass = makePass();
  pass.deviations = calcDeviations(makeErrors(), limits);
  pass.residuals.peak.moment.z() = 90;  // of 75
  pass.residuals.rms.force.y() = 14.9;  // of 15
  const auto figures = listFigures(pass, limits);
  EXPECT_EQ(figures.size(), 2U * 2 + 12);
  const double knee = toDegrees(std::sqrt(0.0025 / 2)) / 2 - 1;
  const double pelvis = std::sqrt(0.001 / 2) / 0.02 - 1;
  EXPECT_NEAR(calcMerit(figures), knee + pelvis + 0.2, tol(1e-12));
  EXPECT_EQ(calcMerit(listFigures(makePass(), limits)), 0);
}

TEST(RraLimits, FiguresCountInTheFieldsUnits) {
  RraPassResult pass = makePass();
  pass.deviations = calcDeviations(makeErrors(), {});
  const auto figures = listFigures(pass, {});
  EXPECT_EQ(figures[1].name, "knee peak");
  EXPECT_EQ(figures[1].unit, "deg");
  EXPECT_NEAR(figures[1].value, toDegrees(0.04), tol(1e-12));
  EXPECT_NEAR(figures[1].limit, 5, tol(1e-12));
  EXPECT_EQ(figures[3].unit, "cm");
  EXPECT_NEAR(figures[3].value, 3, tol(1e-12));
}

// 5 % of the largest vertical force of both feet together, 25 N where that is less.
TEST(RraLimits, ForcePeakGrowsWithTheGroundReaction) {
  GroundReaction reaction;
  reaction.time = {0, 1};
  ExternalForce foot{"r", "calcn_r", {}, {}, {}};
  foot.force = Eigen::Matrix3Xd::Zero(3, 2);
  foot.force(1, 1) = 900;
  reaction.forces = {foot, foot};
  EXPECT_NEAR(resolveLimits({}, reaction).force_peak, 90, tol(1e-12));
  reaction.forces.pop_back();
  EXPECT_NEAR(resolveLimits({}, reaction).force_peak, 45, tol(1e-12));
  EXPECT_EQ(resolveLimits({}, GroundReaction{}).force_peak, 25);
}

}  // namespace
}  // namespace gaitmill

#include "core/sample/foot_loads.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/sample/gait_balance.h"
#include "tests/core/sample/sample_subject.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

class FootLoadsTest : public SampleTest {};

Eigen::Vector3d calcMoment(const FootLoad& load) {
  return load.point.cross(load.force) + load.torque;
}

TEST_F(FootLoadsTest, FeetTogetherGiveTheNetReaction) {
  const Model subject = makeSubject();
  const GaitMotion motion(subject, GaitPattern{});
  FootLoadDistribution distribution(motion);
  for (double t = -0.3; t < 1.5; t += 0.011) {
    const NetReaction net = distribution.calcNet(t);
    const FootLoads loads = distribution.calc(t);
    const Eigen::Vector3d net_moment =
        net.point.cross(net.force) + net.vertical_moment * Eigen::Vector3d::UnitY();
    // Round-off of some hundred operations at 1e3 N and 1e3 N.m.
    EXPECT_LT((loads.right.force + loads.left.force - net.force).norm(), tol(1e-10));
    EXPECT_LT((calcMoment(loads.right) + calcMoment(loads.left) - net_moment).norm(), tol(1e-10));
  }
}

TEST_F(FootLoadsTest, SwingingFootIsFree) {
  const Model subject = makeSubject();
  const GaitMotion motion(subject, GaitPattern{});
  FootLoadDistribution distribution(motion);
  const FootLoads loads = distribution.calc(0.3 * motion.pattern().period);  // left leg swings
  EXPECT_EQ(loads.left.force.norm(), 0.0);
  EXPECT_EQ(loads.left.torque.norm(), 0.0);
  EXPECT_GT(loads.right.force.y(), 0.0);
}

// Force of the leading foot near its strike grows like the cube of time: value, slope and curvature
// vanish.
TEST_F(FootLoadsTest, FootTakesLoadWithoutAKink) {
  const Model subject = makeSubject();
  const GaitMotion motion(subject, GaitPattern{});
  FootLoadDistribution distribution(motion);
  const double near = distribution.calc(0.002).right.force.y();
  const double far = distribution.calc(0.004).right.force.y();
  EXPECT_NEAR(far / near, 8.0, tol(0.3));
}

TEST_F(FootLoadsTest, BalancePutsTheNetReactionUnderTheFeet) {
  const Model subject = makeSubject();
  GaitMotion motion(subject, GaitPattern{});
  const BalanceReport report = balanceGait(motion);
  EXPECT_GT(report.rms_before, 0.1);  // [m] the symmetrized fit alone would fall over sideways
  EXPECT_LT(report.rms_after, 0.015);
  EXPECT_LT(report.largest_after, 0.03);
  EXPECT_LT(report.largest_shift, 0.015);
  EXPECT_LT(report.largest_rotation, 0.02);
}

}  // namespace
}  // namespace gaitmill

#include "core/sample/gait_pattern.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/core/sample/sample_subject.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

class GaitMotionTest : public SampleTest {};

TEST_F(GaitMotionTest, RatesAreDerivativesOfTheCoordinates) {
  const Model subject = makeSubject();
  const GaitMotion motion(subject, GaitPattern{});
  const int n = subject.coordinateCount();
  Eigen::VectorXd q(n), u(n), udot(n), q_before(n), q_after(n), u_before(n), u_after(n), unused(n);
  const double h = 1e-5;
  for (const double t : {-0.21, 0.0, 0.4, 1.3}) {
    motion.calc(t, q, u, udot);
    motion.calc(t - h, q_before, u_before, unused);
    motion.calc(t + h, q_after, u_after, unused);
    // Truncation h^2/6 times the third derivative, below 1e4 for five harmonics; round-off 1e-16/h.
    EXPECT_LT((u - (q_after - q_before) / (2 * h)).cwiseAbs().maxCoeff(), tol(1e-6));
    EXPECT_LT((udot - (u_after - u_before) / (2 * h)).cwiseAbs().maxCoeff(), tol(1e-5));
  }
}

TEST_F(GaitMotionTest, LeftSideRepeatsTheRightHalfACycleLater) {
  const Model subject = makeSubject();
  const GaitPattern pattern;
  const GaitMotion motion(subject, pattern);
  const int n = subject.coordinateCount();
  Eigen::VectorXd now(n), later(n), u(n), udot(n);
  motion.calc(0.3, now, u, udot);
  motion.calc(0.3 + 0.5 * pattern.period, later, u, udot);
  const auto at = [&](const Eigen::VectorXd& q, const char* name) {
    return q[subject.getCoordinate(name).value()];
  };
  EXPECT_NEAR(at(later, "knee_angle_l"), at(now, "knee_angle_r"), tol(1e-14));
  EXPECT_NEAR(at(later, "arm_flex_l"), at(now, "arm_flex_r"), tol(1e-14));
  EXPECT_NEAR(at(later, "pelvis_list"), -at(now, "pelvis_list"), tol(1e-14));
  EXPECT_NEAR(at(later, "pelvis_tilt"), at(now, "pelvis_tilt"), tol(1e-14));
  EXPECT_NEAR(at(later, "pelvis_tx") - at(now, "pelvis_tx"),
              0.5 * pattern.period * pattern.speed,
              tol(1e-14));
}

TEST_F(GaitMotionTest, PatellaFollowsTheKneeAndLockedCoordinatesRest) {
  const Model subject = makeSubject();
  const GaitMotion motion(subject, GaitPattern{});
  const int n = subject.coordinateCount();
  Eigen::VectorXd q(n), u(n), udot(n);
  motion.calc(0.8, q, u, udot);
  const int knee = subject.getCoordinate("knee_angle_r").value();
  const int patella = subject.getCoordinate("knee_angle_r_beta").value();
  EXPECT_NEAR(q[patella], q[knee], tol(1e-14));
  EXPECT_NEAR(udot[patella], udot[knee], tol(1e-12));
  EXPECT_EQ(q[subject.getCoordinate("mtp_angle_r").value()], 0.0);
  EXPECT_EQ(u[subject.getCoordinate("mtp_angle_r").value()], 0.0);
}

TEST_F(GaitMotionTest, AddedTermShowsInItsCoordinateOnly) {
  const Model subject = makeSubject();
  GaitMotion motion(subject, GaitPattern{});
  const int n = subject.coordinateCount();
  Eigen::VectorXd before(n), after(n), u(n), udot(n);
  motion.calc(0.0, before, u, udot);
  motion.addTerm("pelvis_tz", 1, {0.01, 0});
  motion.calc(0.0, after, u, udot);
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(n);
  expected[subject.getCoordinate("pelvis_tz").value()] = 0.01;
  EXPECT_LT((after - before - expected).cwiseAbs().maxCoeff(), tol(1e-15));
  EXPECT_THROW(motion.addTerm("mtp_angle_r", 1, {0.01, 0}), Error);
}

}  // namespace
}  // namespace gaitmill

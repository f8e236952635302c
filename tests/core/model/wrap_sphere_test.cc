#include "core/model/wrap_sphere.h"

#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

using Eigen::Vector3d;
using Status = WrapContact::Status;

WrapSphere makeSphere(double radius, const std::string& quadrant = "all") {
  WrapObjectSpec spec;
  spec.name = "ball";
  spec.kind = WrapObjectSpec::Kind::kSphere;
  spec.radius = radius;
  spec.quadrant = quadrant;
  return makeWrapSphere(spec);
}

double calcTotal(const WrapContact& contact, const Vector3d& P1, const Vector3d& P2) {
  return (contact.r1 - P1).norm() + contact.surface_length + (P2 - contact.r2).norm();
}

// Two tangents of length sqrt(d^2 - r^2) and the arc that they leave of the angle between the ends.
TEST(WrapSphere, LengthIsTwoTangentsAndAnArc) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal(0, 0.06);
  int wrapped = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d P1(normal(generator), normal(generator), normal(generator));
    const Vector3d P2(normal(generator), normal(generator), normal(generator));
    const WrapContact contact = calcWrapContact(makeSphere(0.04), P1, P2);
    if (!contact.wraps()) {
      continue;
    }
    ++wrapped;
    const double d1 = P1.norm(), d2 = P2.norm(), r = 0.04;
    const double between = std::acos(P1.dot(P2) / (d1 * d2));
    const double arc = r * (between - std::acos(r / d1) - std::acos(r / d2));
    const double expected = std::sqrt(d1 * d1 - r * r) + arc + std::sqrt(d2 * d2 - r * r);
    EXPECT_NEAR(calcTotal(contact, P1, P2), expected, tol(2e-9)) << i;  // acos near 1
    EXPECT_NEAR(contact.r1.dot(P1 - contact.r1), 0, tol(1e-16));
    EXPECT_NEAR(contact.r2.dot(P2 - contact.r2), 0, tol(1e-16));
  }
  EXPECT_GT(wrapped, 200);
}

TEST(WrapSphere, LinesBesideItAndEndsWithinItStayStraight) {
  const WrapSphere sphere = makeSphere(0.05);
  EXPECT_EQ(calcWrapContact(sphere, {-0.1, 0.06, 0}, {0.1, 0.06, 0}).status, Status::kNone);
  EXPECT_EQ(calcWrapContact(sphere, {0.06, 0, 0}, {0.1, 0, 0}).status, Status::kNone);
  EXPECT_EQ(calcWrapContact(sphere, {0.04, 0, 0}, {0.1, 0, 0}).status, Status::kInside);
  EXPECT_EQ(calcWrapContact(sphere, {-0.1, 0.01, 0}, {0.1, 0.01, 0}).status, Status::kWrapped);
}

TEST(WrapSphere, ALineThroughTheCentreTakesHalfATurnLessTheTangents) {
  const double r = 0.05, d = 0.1;
  const Vector3d P1(d, 0, 0), P2(-d, 0, 0);
  const double expected = 2 * std::sqrt(d * d - r * r) + r * (kPi - 2 * std::acos(r / d));
  EXPECT_NEAR(calcTotal(calcWrapContact(makeSphere(r), P1, P2), P1, P2), expected, tol(1e-15));
}

// Both ends above: the path is dragged round below, by the complement of the near arc.
TEST(WrapSphere, AHalfSpaceDragsThePathToTheOtherSide) {
  const double r = 0.02;
  const Vector3d P1(0.05, 0.03, 0), P2(-0.05, 0.03, 0);
  const WrapContact contact = calcWrapContact(makeSphere(r, "-y"), P1, P2);
  ASSERT_EQ(contact.status, Status::kWrapped);
  EXPECT_LT(contact.r1.y(), 0);
  EXPECT_LT(contact.r2.y(), 0);
  const double d = P1.norm();
  const double between = std::acos(P1.dot(P2) / (d * d));
  EXPECT_NEAR(contact.surface_length, r * (2 * kPi - between - 2 * std::acos(r / d)), tol(1e-15));
  EXPECT_EQ(calcWrapContact(makeSphere(r, "y"), P1, P2).status, Status::kNone);
}

TEST(WrapSphere, MoreThanHalfATurnCountsAsSuch) {
  const double r = 0.02;
  const Vector3d P1(0.012, 0.04, 0), P2(-0.012, 0.04, 0);
  const WrapContact contact = calcWrapContact(makeSphere(r, "-y"), P1, P2);
  EXPECT_GT(contact.surface_length, kPi * r);
}

TEST(WrapSphere, TracedPointsLieOnItAndDivideTheArc) {
  const WrapSphere sphere = makeSphere(0.04);
  const Vector3d P1(0.09, 0.01, 0.02), P2(-0.08, 0.02, -0.01);
  const WrapContact contact = calcWrapContact(sphere, P1, P2);
  std::vector<Vector3d> points;
  traceSurface(sphere, P1, contact, 9, points);
  ASSERT_EQ(points.size(), 9U);
  points.push_back(contact.r2);
  Vector3d last = contact.r1;
  const double chord = 2 * 0.04 * std::sin(contact.surface_length / 0.04 / 20);
  for (const Vector3d& point : points) {
    EXPECT_NEAR(point.norm(), 0.04, tol(1e-16));
    EXPECT_NEAR((point - last).norm(), chord, tol(1e-15));
    last = point;
  }
}

TEST(WrapSphere, RadiusMustBePositive) {
  try {
    makeSphere(0);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kModelValue);
  }
}

}  // namespace
}  // namespace gaitmill

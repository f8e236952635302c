#include "core/model/wrap_ellipsoid.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/model/wrap_cylinder.h"
#include "core/model/wrap_sphere.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

using Eigen::Vector3d;
using Status = WrapContact::Status;

WrapEllipsoid makeEllipsoid(const Vector3d& semi_axes, const std::string& quadrant = "all") {
  WrapObjectSpec spec;
  spec.name = "condyles";
  spec.kind = WrapObjectSpec::Kind::kEllipsoid;
  spec.semi_axes = semi_axes;
  spec.quadrant = quadrant;
  return makeWrapEllipsoid(spec);
}

double calcTotal(const WrapContact& contact, const Vector3d& P1, const Vector3d& P2) {
  return contact.wraps()
             ? (contact.r1 - P1).norm() + contact.surface_length + (P2 - contact.r2).norm()
             : (P2 - P1).norm();
}

/// How much two links of a chain of points on a surface pull their middle sideways, at most: the
/// first variation of the chain's length, [-]. None on a geodesic, whatever its equations.
double findSidewaysPull(const Vector3d& axes, const std::vector<Vector3d>& chain) {
  double worst = 0;
  for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
    const Vector3d n = chain[i].cwiseQuotient(axes.cwiseAbs2()).normalized();
    const Vector3d pull =
        (chain[i - 1] - chain[i]).normalized() + (chain[i + 1] - chain[i]).normalized();
    const Vector3d along = (chain[i + 1] - chain[i - 1]).normalized();
    worst = std::max(worst, std::abs(pull.dot(n.cross(along))));
  }
  return worst;
}

double calcChainLength(const std::vector<Vector3d>& chain) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    length += (chain[i + 1] - chain[i]).norm();
  }
  return length;
}

struct Segment {
  Vector3d P1, P2;
};

/// Segments whose ends lie up to three times as far out as the surface.
Segment makeSegment(const Vector3d& axes, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> reach(1.1, 3.0);
  const auto point = [&]() -> Vector3d {
    const Vector3d direction =
        Vector3d(normal(generator), normal(generator), normal(generator)).normalized();
    return reach(generator) * direction.cwiseProduct(axes);
  };
  const Vector3d P1 = point();
  return {P1, point()};
}

// The fifteen ellipsoids of the Arnold leg are among these shapes.
const std::vector<Vector3d>& shapes() {
  static const std::vector<Vector3d> all = {{0.052, 0.0492, 0.071},
                                            {0.03, 0.025, 0.05},
                                            {0.0425, 0.069, 0.0572},
                                            {0.0335, 0.02, 0.0833},
                                            {0.0201, 0.1, 0.018},
                                            {0.0218, 0.2, 0.0215}};
  return all;
}

TEST(WrapEllipsoid, EqualAxesAreASphere) {
  WrapObjectSpec spec;
  spec.kind = WrapObjectSpec::Kind::kSphere;
  spec.radius = 0.05;
  const WrapSphere sphere = makeWrapSphere(spec);
  const WrapEllipsoid ellipsoid = makeEllipsoid({0.05, 0.05, 0.05});
  std::mt19937 generator(3);
  int wrapped = 0;
  for (int i = 0; i < 1000; ++i) {
    const Segment s = makeSegment({0.05, 0.05, 0.05}, generator);
    const WrapContact expected = calcWrapContact(sphere, s.P1, s.P2);
    const WrapContact contact = calcWrapContact(ellipsoid, s.P1, s.P2);
    ASSERT_EQ(contact.wraps(), expected.wraps()) << i;
    EXPECT_NEAR(calcTotal(contact, s.P1, s.P2), calcTotal(expected, s.P1, s.P2), tol(1e-8)) << i;
    wrapped += contact.wraps() ? 1 : 0;
  }
  EXPECT_GT(wrapped, 100);
}

// Across its middle a long spheroid is a cylinder, with corrections of the fourth power of the
// distance from the middle over the length.
TEST(WrapEllipsoid, ALongOneIsACylinderAtItsMiddle) {
  WrapObjectSpec spec;
  spec.radius = 0.02;
  spec.length = 10;
  const WrapCylinder cylinder = makeWrapCylinder(spec);
  const Vector3d P1(0.05, 0.01, -0.02), P2(-0.04, 0.012, 0.02);
  const double expected = calcTotal(calcWrapContact(cylinder, P1, P2), P1, P2);
  EXPECT_NEAR(calcTotal(calcWrapContact(makeEllipsoid({0.02, 0.02, 2}), P1, P2), P1, P2),
              expected,
              tol(1e-6));
}

// A thin disc is wrapped at its rim: in the limit the path is two straight lines over an edge.
TEST(WrapEllipsoid, AFlatOneIsADiscWithARim) {
  const Vector3d P1(0.01, 0.06, 0.05), P2(-0.004, 0.07, -0.06);
  const double R = 0.1;
  double disc = 1e9;
  for (int i = 0; i <= 200000; ++i) {
    const double angle = 2 * M_PI * i / 200000;
    const Vector3d rim(R * std::cos(angle), R * std::sin(angle), 0);
    disc = std::min(disc, (rim - P1).norm() + (P2 - rim).norm());
  }
  double last = 1;
  for (const double half_thickness : {0.01, 0.005, 0.0025}) {
    const WrapContact contact = calcWrapContact(makeEllipsoid({R, R, half_thickness}), P1, P2);
    const double excess = std::abs(calcTotal(contact, P1, P2) - disc);
    EXPECT_LT(excess, 0.6 * last) << half_thickness;
    last = excess;
  }
  EXPECT_LT(last, 2e-4);
}

// In a plane of symmetry the geodesic is the ellipse, whose arc is an integral.
TEST(WrapEllipsoid, APathInAPlaneOfSymmetryIsAnEllipse) {
  const Vector3d axes(0.03, 0.05, 0.04);
  const Vector3d P1(0.05, 0.03, 0), P2(-0.06, 0.02, 0);
  const WrapContact contact = calcWrapContact(makeEllipsoid(axes), P1, P2);
  ASSERT_EQ(contact.status, Status::kMandatory);
  EXPECT_NEAR(contact.r1.z(), 0, tol(1e-12));
  const auto angle = [&](const Vector3d& r) {
    return std::atan2(r.y() / axes.y(), r.x() / axes.x());
  };
  const double from = angle(contact.r1), to = angle(contact.r2);
  double arc = 0;
  constexpr int kSteps = 20000;
  for (int i = 0; i < kSteps; ++i) {
    const double t = from + (to - from) * (i + 0.5) / kSteps;
    arc += std::hypot(axes.x() * std::sin(t), axes.y() * std::cos(t)) * (to - from) / kSteps;
  }
  EXPECT_NEAR(contact.surface_length, arc, tol(1e-10));
}

TEST(WrapEllipsoid, MirrorImagesHaveMirroredPaths) {
  std::mt19937 generator(11);
  const Vector3d axes(0.03, 0.025, 0.05);
  const WrapEllipsoid ellipsoid = makeEllipsoid(axes);
  for (int i = 0; i < 300; ++i) {
    const Segment s = makeSegment(axes, generator);
    const double length = calcTotal(calcWrapContact(ellipsoid, s.P1, s.P2), s.P1, s.P2);
    for (int axis = 0; axis < 3; ++axis) {
      Vector3d mirror = Vector3d::Ones();
      mirror[axis] = -1;
      const Vector3d P1 = s.P1.cwiseProduct(mirror), P2 = s.P2.cwiseProduct(mirror);
      EXPECT_NEAR(calcTotal(calcWrapContact(ellipsoid, P1, P2), P1, P2), length, tol(1e-8)) << i;
      EXPECT_NEAR(calcTotal(calcWrapContact(ellipsoid, P2, P1), P2, P1), length, tol(1e-8)) << i;
    }
  }
}

// Two properties of a shortest path that do not use the equations it was found by.
TEST(WrapEllipsoid, NoChainOfPointsIsShorter) {
  std::mt19937 generator(5);
  int total = 0, shorter = 0;
  for (const Vector3d& axes : shapes()) {
    const WrapEllipsoid ellipsoid = makeEllipsoid(axes);
    std::normal_distribution<double> normal(0, 0.02);
    int tried = 0;
    for (int i = 0; i < 200; ++i) {
      const Segment s = makeSegment(axes, generator);
      const WrapContact contact = calcWrapContact(ellipsoid, s.P1, s.P2);
      if (!contact.wraps()) {
        continue;
      }
      std::vector<Vector3d> arc;
      traceSurface(ellipsoid, s.P1, contact, 199, arc);
      arc.insert(arc.begin(), contact.r1);
      arc.push_back(contact.r2);
      // The chords of the arc miss of its length what (angle of a step)^2 / 24 says.
      const double straight = calcChainLength(arc);
      EXPECT_NEAR(straight, contact.surface_length, tol(1e-3) * contact.surface_length) << i;
      EXPECT_LT(findSidewaysPull(axes, arc), tol(1e-4)) << i << " " << axes.transpose();
      // Bumps sideways make the chain longer.
      std::vector<Vector3d> bumped = arc;
      const double bump = normal(generator);
      for (std::size_t k = 0; k < arc.size(); ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(arc.size() - 1);
        const Vector3d n = arc[k].cwiseQuotient(axes.cwiseAbs2()).normalized();
        const Vector3d along =
            (arc[std::min(k + 1, arc.size() - 1)] - arc[k > 0 ? k - 1 : 0]).normalized();
        const Vector3d moved =
            arc[k] + bump * axes.minCoeff() * std::sin(M_PI * share) * n.cross(along);
        bumped[k] = moved / moved.cwiseQuotient(axes).norm();
      }
      shorter += calcChainLength(bumped) < straight * (1 - 1e-6) ? 1 : 0;  // chords, not arcs
      ++tried;
    }
    EXPECT_GT(tried, 20);
    total += tried;
  }
  // Some ends see no geodesic; there the path is the plane's section.
  EXPECT_LE(shorter, total / 50);
}

// Envelope theorem: the pull at an end is the gradient of the length. True wherever the path does
// not change sides between the poses of the difference.
TEST(WrapEllipsoid, DirectionsAtTheEndsAreTheGradientOfTheLength) {
  std::mt19937 generator(17);
  constexpr double h = 1e-6;
  for (const Vector3d& axes : shapes()) {
    const WrapEllipsoid ellipsoid = makeEllipsoid(axes);
    int tried = 0, apart = 0;
    for (int i = 0; i < 300; ++i) {
      const Segment s = makeSegment(axes, generator);
      const WrapContact contact = calcWrapContact(ellipsoid, s.P1, s.P2);
      if (!contact.wraps()) {
        continue;
      }
      const auto lengthAt = [&](const Vector3d& dP1, const Vector3d& dP2) {
        const Vector3d P1 = s.P1 + dP1, P2 = s.P2 + dP2;
        return calcTotal(calcWrapContact(ellipsoid, P1, P2), P1, P2);
      };
      Vector3d slope1, slope2;
      for (int k = 0; k < 3; ++k) {
        const Vector3d step = h * Vector3d::Unit(k);
        const Vector3d none = Vector3d::Zero();
        slope1[k] = (lengthAt(step, none) - lengthAt(-step, none)) / (2 * h);
        slope2[k] = (lengthAt(none, step) - lengthAt(none, -step)) / (2 * h);
      }
      const double miss1 = (slope1 - (s.P1 - contact.r1).normalized()).norm();
      const double miss2 = (slope2 - (s.P2 - contact.r2).normalized()).norm();
      ++tried;
      apart += std::max(miss1, miss2) > tol(2e-6) ? 1 : 0;
    }
    EXPECT_GT(tried, 30);
    EXPECT_LE(apart, tried / 50) << axes.transpose();
  }
}

TEST(WrapEllipsoid, LengthGrowsFromTheStraightLineAtTheFirstTouch) {
  const WrapEllipsoid ellipsoid = makeEllipsoid({0.03, 0.025, 0.05});
  double last = 0;
  for (int i = 0; i <= 2000; ++i) {
    const double y = 0.027 - 1e-5 * i;
    const Vector3d P1(0.08, y, 0.01), P2(-0.07, y, 0.013);
    const double detour = calcTotal(calcWrapContact(ellipsoid, P1, P2), P1, P2) - (P2 - P1).norm();
    EXPECT_GE(detour, last - 1e-12) << y;
    EXPECT_LT(detour - last, 2e-5) << y;
    last = detour;
  }
  EXPECT_GT(last, 0.004);
}

TEST(WrapEllipsoid, LinesBesideItAndEndsWithinItStayStraight) {
  const WrapEllipsoid ellipsoid = makeEllipsoid({0.03, 0.025, 0.05});
  EXPECT_EQ(calcWrapContact(ellipsoid, {-0.1, 0.026, 0}, {0.1, 0.026, 0}).status, Status::kNone);
  EXPECT_EQ(calcWrapContact(ellipsoid, {0.031, 0, 0}, {0.1, 0, 0}).status, Status::kNone);
  EXPECT_EQ(calcWrapContact(ellipsoid, {0.029, 0, 0}, {0.1, 0, 0}).status, Status::kInside);
}

TEST(WrapEllipsoid, AHalfSpaceChoosesTheSideOfTheCrest) {
  const Vector3d axes(0.03, 0.025, 0.05);
  const Vector3d P1(0.05, 0.01, 0.01), P2(-0.06, 0.008, 0.0);
  const WrapContact above = calcWrapContact(makeEllipsoid(axes, "y"), P1, P2);
  const WrapContact below = calcWrapContact(makeEllipsoid(axes, "-y"), P1, P2);
  ASSERT_EQ(below.status, Status::kMandatory);
  EXPECT_GT(above.r1.y() + above.r2.y(), 0);
  EXPECT_LT(below.r1.y() + below.r2.y(), 0);
  EXPECT_GT(calcTotal(below, P1, P2), calcTotal(above, P1, P2));
  EXPECT_NEAR(below.r1.cwiseQuotient(axes).norm(), 1, tol(1e-12));
}

TEST(WrapEllipsoid, SolvesWithoutAllocating) {
  const WrapEllipsoid ellipsoid = makeEllipsoid({0.0218, 0.2, 0.0215});
  WrapContact contact;
  EXPECT_EQ(countAllocationsOf([&] {
              contact = calcWrapContact(ellipsoid, {0.05, 0.02, 0.005}, {-0.05, 0.03, 0.01});
            }),
            0);
  EXPECT_TRUE(contact.wraps());
}

TEST(WrapEllipsoid, AxesMustBePositive) {
  try {
    makeEllipsoid({0.1, 0, 0.1});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kModelValue);
  }
}

}  // namespace
}  // namespace gaitmill

#include "core/model/wrap_cylinder.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

using Eigen::Vector3d;
using Status = WrapContact::Status;

struct SegmentCase {
  const char* name;
  Vector3d P1, P2;
  const char* quadrant;
  double length;
  Status status;
  double theta;  // signed, in (-pi, pi]
  Vector3d r1, r2;
  double total;
};

WrapCylinder makeCase(const SegmentCase& c) {
  WrapObjectSpec spec;
  spec.name = c.name;
  spec.radius = 0.02;
  spec.length = c.length;
  spec.quadrant = c.quadrant;
  return makeWrapCylinder(spec);
}

double calcTotal(const SegmentCase& c, const WrapContact& contact) {
  if (!contact.wraps()) {
    return (c.P2 - c.P1).norm();
  }
  return (contact.r1 - c.P1).norm() + contact.surface_length + (c.P2 - contact.r2).norm();
}

// The 17 cases of spec/path.md 5.8, radius 0.02 m.
const std::vector<SegmentCase>& segmentCases() {
  const Vector3d none = Vector3d::Zero();
  static const std::vector<SegmentCase> cases = {{"1 planar hit",
                                                  {0.05, 0.005, 0.01},
                                                  {-0.05, 0.005, 0.01},
                                                  "all",
                                                  0.1,
                                                  Status::kMandatory,
                                                  0.619366534,
                                                  {0.00609513971, 0.0190486029, 0.01},
                                                  {-0.00609513971, 0.0190486029, 0.01},
                                                  0.104582775248},
                                                 {"2 axial offset",
                                                  {0.05, 0.005, 0.001},
                                                  {-0.05, 0.005, 0.041},
                                                  "all",
                                                  0.1,
                                                  Status::kMandatory,
                                                  0.619366534,
                                                  {0.00609513971, 0.0190486029, 0.0186310954},
                                                  {-0.00609513971, 0.0190486029, 0.0233689046},
                                                  0.111971232371},
                                                 {"3 opposite sides",
                                                  {0.05, 0.015, -0.01},
                                                  {-0.06, -0.012, 0.02},
                                                  "all",
                                                  0.1,
                                                  Status::kMandatory,
                                                  0.632101214,
                                                  {0.00203101793, 0.0198966069, 0.00218785725},
                                                  {-0.0101171365, 0.0172523491, 0.00538331073},
                                                  0.122420374605},
                                                 {"4 line misses",
                                                  {0.05, 0.03, 0.01},
                                                  {-0.05, 0.03, 0.01},
                                                  "all",
                                                  0.1,
                                                  Status::kNone,
                                                  0,
                                                  none,
                                                  none,
                                                  0.1},
                                                 {"5 foot outside the segment",
                                                  {0.05, 0.005, 0.01},
                                                  {0.03, 0.006, 0.02},
                                                  "all",
                                                  0.1,
                                                  Status::kNone,
                                                  0,
                                                  none,
                                                  none,
                                                  std::sqrt(0.0004 + 0.000001 + 0.0001)},
                                                 {"6 end inside",
                                                  {0.01, 0.005, 0.01},
                                                  {-0.05, 0.005, 0.01},
                                                  "all",
                                                  0.1,
                                                  Status::kInside,
                                                  0,
                                                  none,
                                                  none,
                                                  0.06},
                                                 {"7 beyond the length",
                                                  {0.05, 0.005, 0.06},
                                                  {-0.05, 0.005, 0.07},
                                                  "all",
                                                  0.1,
                                                  Status::kNone,
                                                  0,
                                                  none,
                                                  none,
                                                  std::sqrt(0.01 + 0.0001)},
                                                 {"8 one tangent beyond",
                                                  {0.05, 0.005, 0.02},
                                                  {-0.05, 0.005, 0.09},
                                                  "all",
                                                  0.11,
                                                  Status::kMandatory,
                                                  0.619366534,
                                                  {0.00609513971, 0.0190486029, 0.050854417},
                                                  {-0.00609513971, 0.0190486029, 0.059145583},
                                                  0.125847355469},
                                                 {"9 active +y, hit",
                                                  {0.05, 0.015, 0.001},
                                                  {-0.05, 0.01, 0.02},
                                                  "y",
                                                  0.1,
                                                  Status::kMandatory,
                                                  0.307387768,
                                                  {0.00203101793, 0.0198966069, 0.0100465618},
                                                  {-0.00408429557, 0.0195785222, 0.0111999849},
                                                  0.103037113104},
                                                 {"10 active -y, hit on the other half",
                                                  {0.05, 0.015, 0.001},
                                                  {-0.05, -0.01, 0.02},
                                                  "-y",
                                                  0.1,
                                                  Status::kMandatory,
                                                  -0.890301357,
                                                  {0.0126478812, -0.0154929372, 0.00911263163},
                                                  {-0.00408429557, -0.0195785222, 0.0121084626},
                                                  0.114515641867},
                                                 {"11 both active, miss",
                                                  {0.05, 0.03, 0.001},
                                                  {-0.05, 0.04, 0.002},
                                                  "y",
                                                  0.1,
                                                  Status::kNone,
                                                  0,
                                                  none,
                                                  none,
                                                  std::sqrt(0.01 + 0.0001 + 0.000001)},
                                                 {"12 both inactive",
                                                  {0.05, 0.03, 0.001},
                                                  {-0.05, 0.03, 0.02},
                                                  "-y",
                                                  0.1,
                                                  Status::kWrapped,
                                                  -1.78105056,
                                                  {0.0155480451, -0.0125800752, 0.00816887068},
                                                  {-0.0155480451, -0.0125800752, 0.0128311293},
                                                  0.146403650768},
                                                 {"13 foot on inactive side",
                                                  {0.06, 0.005, 0.001},
                                                  {-0.02, -0.08, 0.01},
                                                  "y",
                                                  0.1,
                                                  Status::kWrapped,
                                                  1.82627101,
                                                  {0.00505409425, 0.019350869, 0.00394898431},
                                                  {-0.02, 0, 0.00584570255},
                                                  0.173548025541},
                                                 {"14 foot on active side",
                                                  {0.06, -0.005, 0.001},
                                                  {-0.02, 0.08, 0.01},
                                                  "y",
                                                  0.1,
                                                  Status::kNone,
                                                  0,
                                                  none,
                                                  none,
                                                  std::sqrt(0.0064 + 0.007225 + 0.000081)},
                                                 {"15 -x half, hit",
                                                  {0.03, 0.05, 0.01},
                                                  {-0.035, -0.045, -0.02},
                                                  "-x",
                                                  0.1,
                                                  Status::kMandatory,
                                                  0.587932149,
                                                  {-0.0125800752, 0.0155480451, -0.00370262266},
                                                  {-0.0190913391, 0.00595993043, -0.00664433549},
                                                  0.123611959795},
                                                 {"16 long, clockwise",
                                                  {0.012, 0.04, 0.001},
                                                  {-0.012, 0.04, 0.011},
                                                  "-y",
                                                  0.1,
                                                  Status::kWrapped,
                                                  2.7256738,
                                                  {0.0195690851, 0.00412927446, 0.00353756765},
                                                  {-0.0195690851, 0.00412927446, 0.00846243235},
                                                  0.144817116863},
                                                 {"17 long, counter-clockwise",
                                                  {0.012, -0.04, 0.001},
                                                  {-0.012, -0.04, 0.011},
                                                  "y",
                                                  0.1,
                                                  Status::kWrapped,
                                                  -2.7256738,
                                                  {0.0195690851, -0.00412927446, 0.00353756765},
                                                  {-0.0195690851, -0.00412927446, 0.00846243235},
                                                  0.144817116863}};
  return cases;
}

TEST(WrapCylinder, SegmentCasesMatchTheExactGeodesic) {
  for (const SegmentCase& c : segmentCases()) {
    const WrapContact contact = calcWrapContact(makeCase(c), c.P1, c.P2);
    EXPECT_EQ(static_cast<int>(contact.status), static_cast<int>(c.status)) << c.name;
    EXPECT_NEAR(calcTotal(c, contact), c.total, tol(1e-9)) << c.name;
    if (contact.wraps()) {
      EXPECT_NEAR((contact.r1 - c.r1).norm(), 0, tol(1e-9)) << c.name;
      EXPECT_NEAR((contact.r2 - c.r2).norm(), 0, tol(1e-9)) << c.name;
      EXPECT_NEAR(std::remainder(contact.turn - c.theta, 2 * kPi), 0, tol(1e-8)) << c.name;
    }
  }
}

TEST(WrapCylinder, PathAndReversePathHaveOneLength) {
  for (const SegmentCase& c : segmentCases()) {
    const SegmentCase reversed{
        c.name, c.P2, c.P1, c.quadrant, c.length, c.status, 0, c.r2, c.r1, c.total};
    EXPECT_NEAR(calcTotal(reversed, calcWrapContact(makeCase(c), c.P2, c.P1)), c.total, tol(1e-9))
        << c.name;
  }
}

// A geodesic crosses every generator at one angle: tangents and helix have the same slope.
TEST(WrapCylinder, TangentsContinueTheHelix) {
  const SegmentCase& c = segmentCases()[1];
  const WrapContact contact = calcWrapContact(makeCase(c), c.P1, c.P2);
  const auto slope = [](const Vector3d& a, const Vector3d& b) {
    return (b - a).normalized().z();
  };
  const double helix = (contact.r2.z() - contact.r1.z()) / contact.surface_length;
  EXPECT_NEAR(slope(c.P1, contact.r1), helix, tol(1e-14));
  EXPECT_NEAR(slope(contact.r2, c.P2), helix, tol(1e-14));
}

TEST(WrapCylinder, UnknownQuadrantAndRadiusAreRefused) {
  WrapObjectSpec spec;
  spec.name = "w";
  spec.radius = 0.02;
  spec.quadrant = "+w";
  EXPECT_THROW(makeWrapCylinder(spec), Error);
  spec.quadrant = "all";
  spec.radius = 0;
  EXPECT_THROW(makeWrapCylinder(spec), Error);
}

}  // namespace
}  // namespace gaitmill

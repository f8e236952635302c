#include "core/render/surface.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr Rgb kRed{200, 10, 20};

// Signed volume by the divergence theorem: positive if corners run counter-clockwise from outside.
double calcVolume(const Surface& surface) {
  double volume = 0;
  for (std::size_t i = 0; i < surface.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) {
      return surface.vertices[surface.indices[i + k]].position.cast<double>().eval();
    };
    volume += corner(0).dot(corner(1).cross(corner(2))) / 6;
  }
  return volume;
}

void expectUnitNormals(const Surface& surface) {
  for (const SurfaceVertex& v : surface.vertices) {
    EXPECT_NEAR(static_cast<double>(v.normal.norm()), 1, tol(1e-6));
  }
}

TEST(Surface, SphereHasItsVolumeAndFacesOutwards) {
  Surface surface;
  addSphere({1, 2, 3}, 0.5, {kRed, 9}, surface);
  expectUnitNormals(surface);
  const double ball = 4.0 / 3 * kPi * 0.125;
  EXPECT_GT(calcVolume(surface), 0.8 * ball);  // twelve flat sides
  EXPECT_LT(calcVolume(surface), ball);
  for (const SurfaceVertex& v : surface.vertices) {
    EXPECT_NEAR(
        static_cast<double>((v.position - Eigen::Vector3f(1, 2, 3)).norm()), 0.5, tol(1e-6));
    EXPECT_EQ(v.color, kRed);
    EXPECT_EQ(v.weight, 9);
  }
}

TEST(Surface, TubeFollowsItsRings) {
  std::vector<TubeRing> rings;
  for (int i = 0; i <= 20; ++i) {
    const double angle = 0.1 * i;
    rings.push_back({{std::cos(angle), std::sin(angle), 0.05 * angle}, 0.02 + 0.001 * i, kRed});
  }
  Surface surface;
  addTube(rings, 0, surface);
  expectUnitNormals(surface);
  const std::size_t sides = surface.vertices.size() / rings.size();
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    const TubeRing& ring = rings[i / sides];
    const Eigen::Vector3d arm = surface.vertices[i].position.cast<double>() - ring.center;
    EXPECT_NEAR(arm.norm(), ring.radius, tol(1e-6));
    EXPECT_GT(arm.normalized().dot(surface.vertices[i].normal.cast<double>()), 0.9);  // outwards
  }
}

// Seen from outside, so that back faces may be left out.
TEST(Surface, TubeRunsCounterClockwise) {
  Surface surface;
  addTube({{{0, 0, 0}, 0.1, kRed}, {{0, 1, 0}, 0.1, kRed}}, 0, surface);
  for (std::size_t i = 0; i < surface.indices.size(); i += 3) {
    const SurfaceVertex& a = surface.vertices[surface.indices[i]];
    const SurfaceVertex& b = surface.vertices[surface.indices[i + 1]];
    const SurfaceVertex& c = surface.vertices[surface.indices[i + 2]];
    const Eigen::Vector3f across = (b.position - a.position).cross(c.position - a.position);
    EXPECT_GT(across.dot(a.normal), 0);
  }
}

TEST(Surface, TubeOfLessThanTwoRingsIsNothing) {
  Surface surface;
  addTube({}, 0, surface);
  addTube({{{0, 0, 0}, 0.1, kRed}}, 0, surface);
  EXPECT_TRUE(surface.vertices.empty());
  EXPECT_TRUE(surface.indices.empty());
}

// A path may touch the same point twice, or turn back on itself.
TEST(Surface, TubeThroughEqualAndReversedPointsStaysFinite) {
  Surface surface;
  addTube({{{0, 0, 0}, 0.1, kRed},
           {{0, 0, 0}, 0.1, kRed},
           {{1, 0, 0}, 0.1, kRed},
           {{0, 0, 0}, 0.1, kRed}},
          0,
          surface);
  for (const SurfaceVertex& v : surface.vertices) {
    EXPECT_TRUE(v.position.allFinite());
    EXPECT_TRUE(v.normal.allFinite());
  }
}

TEST(Surface, ArrowReachesFromTailToTip) {
  const Eigen::Vector3d tail(1, 0, 2), direction = Eigen::Vector3d(0.1, 1, 0).normalized();
  Surface surface;
  addArrow(tail, direction, 0.6, 0.01, {kRed, 0}, surface);
  double lowest = 1e9, highest = -1e9;
  for (const SurfaceVertex& v : surface.vertices) {
    const double along = direction.dot(v.position.cast<double>() - tail);
    lowest = std::min(lowest, along);
    highest = std::max(highest, along);
  }
  EXPECT_NEAR(lowest, 0, tol(1e-6));
  EXPECT_NEAR(highest, 0.6, tol(1e-6));
}

TEST(Surface, MeshIsPlacedByItsPose) {
  const Mesh mesh{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}, {{0, 1, 2}}};
  Pose pose;
  pose.R = Eigen::AngleAxisd(0.5 * kPi, Eigen::Vector3d::UnitY()).toRotationMatrix();
  pose.p = {5, 6, 7};
  Surface surface;
  addSphere({0, 0, 0}, 1, {kRed, 0}, surface);
  const std::size_t before = surface.vertices.size();
  addMesh(mesh, pose, {kRed, 3}, surface);
  const SurfaceVertex& corner = surface.vertices[before + 1];
  EXPECT_NEAR(
      static_cast<double>((corner.position - Eigen::Vector3f(5, 6, 6)).norm()), 0, tol(1e-6));
  EXPECT_NEAR(static_cast<double>(corner.normal.x()), 1, tol(1e-6));
  EXPECT_EQ(surface.indices.back(), before + 2);
}

}  // namespace
}  // namespace gaitmill

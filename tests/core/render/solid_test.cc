#include "core/render/solid.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/render/mesh_kit.h"
#include "tests/support/mesh_checks.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

using Vector3d = Eigen::Vector3d;

// Vertices lie on the ball to first order, so that the volume errs by the chords only: a few
// (cell / radius)^2.
TEST(Solid, BallIsRoundClosedAndLooksOutward) {
  Solid ball;
  ball.addEllipsoid({0.1, 0.2, 0.3}, {0.05, 0.05, 0.05}, 0);
  const Mesh mesh = ball.makeMesh(Vector3d::Constant(0.005));
  EXPECT_TRUE(isClosed(mesh));
  EXPECT_NEAR(calcVolume(mesh) / (4.0 / 3.0 * M_PI * std::pow(0.05, 3)), 1, tol(0.01));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vector3d radius = mesh.vertices[i].cast<double>() - Vector3d(0.1, 0.2, 0.3);
    EXPECT_NEAR(radius.norm(), 0.05, tol(2e-4));
    EXPECT_NEAR(radius.normalized().dot(mesh.normals[i].cast<double>()), 1, tol(1e-3));
  }
}

TEST(Solid, DistanceToATubeIsExact) {
  Solid tube;
  tube.addStroke({{{0, 0, 0}, 0.1}, {{1, 0, 0}, 0.1}}, 0);
  EXPECT_NEAR(tube.calcDistance({0.5, 0.3, 0}), 0.2, tol(1e-12));
  EXPECT_NEAR(tube.calcDistance({0.5, 0, 0.02}), -0.08, tol(1e-12));
  EXPECT_NEAR(tube.calcDistance({1.3, 0.4, 0}), 0.4, tol(1e-12));
}

TEST(Solid, FlatTubeIsThinAlongItsThinDirection) {
  Solid tube;
  tube.addStroke({{{0, 0, 0}, 0.1}, {{1, 0, 0}, 0.1}}, 0, {Vector3d::UnitY(), 0.5});
  EXPECT_NEAR(tube.calcDistance({0.5, 0.05, 0}), 0, tol(1e-12));
  EXPECT_NEAR(tube.calcDistance({0.5, 0, 0.1}), 0, tol(1e-12));
}

TEST(Solid, SheetHasItsThickness) {
  Solid sheet;
  sheet.addSheet({{{{0, 0, 0}, 0.01}, {{1, 0, 0}, 0.01}}, {{{0, 1, 0}, 0.01}, {{1, 1, 0}, 0.01}}},
                 0);
  EXPECT_NEAR(sheet.calcDistance({0.3, 0.4, 0.05}), 0.04, tol(1e-12));
  EXPECT_NEAR(sheet.calcDistance({1.03, 1.04, 0}), 0.04, tol(1e-12));
}

TEST(Solid, CarvedAndCutPartsAreGone) {
  Solid solid;
  solid.addEllipsoid({0, 0, 0}, {1, 1, 1}, 0);
  solid.carveEllipsoid({0, 0, 1}, {0.5, 0.5, 0.5}, 0);
  solid.cut({0, -0.5, 0}, {0, -1, 0}, 0);
  EXPECT_GT(solid.calcDistance({0, 0, 0.8}), 0);
  EXPECT_GT(solid.calcDistance({0, -0.6, 0}), 0);
  EXPECT_LT(solid.calcDistance({0, 0, 0}), 0);
}

TEST(Solid, BlendFillsTheCornerBetweenParts) {
  Solid sharp, blended;
  for (Solid* solid : {&sharp, &blended}) {
    solid->addEllipsoid({-0.5, 0, 0}, {0.6, 0.6, 0.6}, 0);
    solid->addEllipsoid({0.5, 0, 0}, {0.6, 0.6, 0.6}, solid == &sharp ? 0 : 0.3);
  }
  EXPECT_GT(sharp.calcDistance({0, 0.36, 0}), 0);
  EXPECT_LT(blended.calcDistance({0, 0.36, 0}), 0);
}

// What is selected near a block must not change the surface: a fine grid and a coarse one agree.
TEST(Solid, SizeOfTheGridHardlyMatters) {
  Solid bone;
  bone.addStroke({{{0, 0, 0}, 0.02}, {{0.02, 0.1, 0}, 0.01}, {{0, 0.2, 0}, 0.02}}, 0);
  bone.addEllipsoid({0.03, 0.2, 0}, {0.03, 0.02, 0.02}, 0.02);
  const double fine = calcVolume(bone.makeMesh(Vector3d::Constant(0.002)));
  const double coarse = calcVolume(bone.makeMesh({0.004, 0.006, 0.004}));
  EXPECT_NEAR(coarse / fine, 1, tol(0.02));
}

TEST(MeshKit, TubeIsAClosedCylinderWithRoundEnds) {
  const Mesh tube = makeTube({{{0, 0, 0}, 0.1}, {{0, 1, 0}, 0.1}}, {64, 1, 1, {}});
  EXPECT_TRUE(isClosed(tube));
  EXPECT_NEAR(calcVolume(tube), M_PI * 0.01 + 4.0 / 3.0 * M_PI * 0.001, tol(4e-4));
}

TEST(MeshKit, EllipsoidIsClosed) {
  const Mesh mesh = makeEllipsoid({1, 2, 3}, {0.1, 0.2, 0.3}, Eigen::Matrix3d::Identity(), 32, 24);
  EXPECT_TRUE(isClosed(mesh));
  EXPECT_NEAR(calcVolume(mesh) / (4.0 / 3.0 * M_PI * 0.006), 1, tol(0.02));
}

TEST(MeshKit, MirroredMeshStillLooksOutward) {
  Mesh mesh = makeEllipsoid({1, 2, 3}, {0.1, 0.2, 0.3}, Eigen::Matrix3d::Identity(), 16, 8);
  const double volume = calcVolume(mesh);
  scaleMesh(mesh, {2, 1, -1});
  EXPECT_NEAR(calcVolume(mesh) / volume, 2, tol(1e-5));
  EXPECT_GT(mesh.normals[0].dot(mesh.vertices[0] - Eigen::Vector3f(2, 2, -3)), 0.0F);
}

}  // namespace
}  // namespace gaitmill

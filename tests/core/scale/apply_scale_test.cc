#include "core/scale/apply_scale.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/simple_models.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

/// A thigh-like rod on a hinge with one muscle along it, a wrap cylinder and a marker.
ModelSpec makeRod() {
  ModelSpec spec;
  BodySpec rod;
  rod.name = "rod";
  rod.mass = 2;
  rod.mass_center = {0, -0.2, 0.1};
  rod.inertia = {0.05, 0.01, 0.05, 0, 0, 0};
  WrapObjectSpec wrap;
  wrap.name = "condyle";
  wrap.translation = {0.3, 0.1, 0.2};
  wrap.radius = 0.02;
  wrap.length = 0.1;
  rod.wrap_objects.push_back(wrap);
  rod.meshes.push_back({"rod.vtp", {0.85, 0.85, 0.85}, {0, 0.1, 0}, {0, 0, 0}});
  spec.bodies.push_back(rod);
  JointSpec joint;
  joint.name = "hinge";
  joint.kind = JointSpec::Kind::kPin;
  joint.parent.body = "ground";
  joint.parent.translation = {0, 1, 0};
  joint.child.body = "rod";
  joint.child.translation = {0, 0.05, 0};
  joint.coordinates.emplace_back();
  joint.coordinates.back().name = "angle";
  spec.joints.push_back(joint);
  spec.markers.push_back({"M", "rod", {0.01, -0.3, 0.02}, false});
  MuscleSpec muscle;
  muscle.name = "m";
  muscle.max_isometric_force = 100;
  muscle.optimal_fiber_length = 0.1;
  muscle.tendon_slack_length = 0.2;
  muscle.path = {{"rod", {0, 0, 0}}, {"rod", {0, -0.4, 0}}};
  spec.muscles.push_back(muscle);
  return spec;
}

constexpr auto kPreserved = MassDistribution::kPreserved;
constexpr auto kFollowsVolume = MassDistribution::kFollowsVolume;

TEST(ApplyScale, FactorOneIsIdentity) {
  const ModelSpec rod = makeRod();
  const ModelSpec scaled = applyScaleFactors(rod, {{"rod", {1, 1, 1}}}, kFollowsVolume);
  EXPECT_EQ(scaled.bodies[0].mass, rod.bodies[0].mass);
  EXPECT_EQ(scaled.bodies[0].inertia, rod.bodies[0].inertia);
  EXPECT_EQ(scaled.markers[0].location, rod.markers[0].location);
  EXPECT_EQ(scaled.muscles[0].optimal_fiber_length, rod.muscles[0].optimal_fiber_length);
}

TEST(ApplyScale, BodyFixedPointsStretchWithTheirBody) {
  const ModelSpec scaled = applyScaleFactors(makeRod(), {{"rod", {1.1, 1.2, 1.3}}}, kPreserved);
  EXPECT_TRUE(scaled.markers[0].location.isApprox(Eigen::Vector3d(0.011, -0.36, 0.026), 1e-14));
  EXPECT_TRUE(scaled.bodies[0].mass_center.isApprox(Eigen::Vector3d(0, -0.24, 0.13), 1e-14));
  EXPECT_TRUE(scaled.joints[0].child.translation.isApprox(Eigen::Vector3d(0, 0.06, 0), 1e-14));
  EXPECT_EQ(scaled.joints[0].parent.translation, Eigen::Vector3d(0, 1, 0));  // on ground
}

TEST(ApplyScale, WrapCylinderTakesTheMeanOfItsRadialFactors) {
  const ModelSpec scaled = applyScaleFactors(makeRod(), {{"rod", {1.1, 1.3, 1.5}}}, kPreserved);
  const WrapObjectSpec& wrap = scaled.bodies[0].wrap_objects[0];
  EXPECT_NEAR(wrap.radius, 0.02 * 1.2, tol(1e-15));
  EXPECT_NEAR(wrap.length, 0.1 * 1.5, tol(1e-15));
}

TEST(ApplyScale, MeshesStretchWithTheirBody) {
  const ModelSpec scaled = applyScaleFactors(makeRod(), {{"rod", {1.1, 1.2, 1.3}}}, kPreserved);
  const MeshSpec& mesh = scaled.bodies[0].meshes[0];
  EXPECT_TRUE(mesh.scale_factors.isApprox(0.85 * Eigen::Vector3d(1.1, 1.2, 1.3), 1e-14));
  EXPECT_TRUE(mesh.translation.isApprox(Eigen::Vector3d(0, 0.12, 0), 1e-14));
}

TEST(ApplyScale, MuscleLengthsFollowThePath) {
  const ModelSpec scaled = applyScaleFactors(makeRod(), {{"rod", {1, 1.25, 1}}}, kPreserved);
  EXPECT_NEAR(scaled.muscles[0].optimal_fiber_length, 0.125, tol(1e-14));
  EXPECT_NEAR(scaled.muscles[0].tendon_slack_length, 0.25, tol(1e-14));
  EXPECT_EQ(scaled.muscles[0].max_isometric_force, 100);
}

TEST(ApplyScale, EvenStretchScalesInertiaWithMassAndArea) {
  const ModelSpec kept = applyScaleFactors(makeRod(), {{"rod", {2, 2, 2}}}, kPreserved);
  EXPECT_NEAR(kept.bodies[0].inertia[0], 0.05 * 4, tol(1e-15));
  const ModelSpec grown = applyScaleFactors(makeRod(), {{"rod", {2, 2, 2}}}, kFollowsVolume);
  EXPECT_NEAR(grown.bodies[0].mass, 16, tol(1e-14));
  EXPECT_NEAR(grown.bodies[0].inertia[0], 0.05 * 32, tol(1e-14));
}

// r^2 = 2 I_yy/m = 0.01, L^2 = 12 (I_xx - m r^2/4)/m = 0.27: the rod is a cylinder along y.
TEST(ApplyScale, UnevenStretchTakesTheStretchedCylinder) {
  const ModelSpec scaled = applyScaleFactors(makeRod(), {{"rod", {1, 2, 1}}}, kPreserved);
  EXPECT_NEAR(scaled.bodies[0].inertia[1], 2 * 0.01 / 2, tol(1e-15));
  EXPECT_NEAR(scaled.bodies[0].inertia[0], 2 * (0.27 * 4 / 12 + 0.01 / 4), tol(1e-14));
  EXPECT_EQ(scaled.bodies[0].inertia[0], scaled.bodies[0].inertia[2]);
}

TEST(ApplyScale, TranslationFunctionsOfACustomJointTakeTheParentsFactors) {
  ModelSpec spec = makeRod();
  BodySpec tip = spec.bodies[0];
  tip.name = "tip";
  tip.wrap_objects.clear();
  spec.bodies.push_back(tip);
  JointSpec joint;
  joint.name = "slide";
  joint.kind = JointSpec::Kind::kCustom;
  joint.parent.body = "rod";
  joint.child.body = "tip";
  joint.coordinates.emplace_back();
  joint.coordinates.back().name = "bend";
  using Eigen::Vector3d;
  joint.axes[0] = {"bend", Vector3d::UnitZ(), {FunctionSpec::Kind::kLinear, {}, {1, 0}, 1}};
  joint.axes[1].axis = Vector3d::UnitX();
  joint.axes[2].axis = Vector3d::UnitY();
  joint.axes[3] = {"bend", {0.6, 0.8, 0}, {FunctionSpec::Kind::kPolynomial, {}, {0.01, 0, 0}, 1}};
  joint.axes[4] = {"", {0.8, -0.6, 0}, {FunctionSpec::Kind::kConstant, {}, {0.02}, 1}};
  joint.axes[5] = {"", Vector3d::UnitZ(), {FunctionSpec::Kind::kConstant, {}, {0.03}, 1}};
  spec.joints.push_back(joint);
  const ModelSpec scaled =
      applyScaleFactors(spec, {{"rod", {2, 3, 4}}, {"tip", {9, 9, 9}}}, kPreserved);
  EXPECT_NEAR(scaled.joints[1].axes[3].function.scale, 0.6 * 2 + 0.8 * 3, tol(1e-14));
  EXPECT_NEAR(scaled.joints[1].axes[4].function.scale, 0.8 * 2 + 0.6 * 3, tol(1e-14));
  EXPECT_NEAR(scaled.joints[1].axes[5].function.scale, 4, tol(1e-14));
  EXPECT_EQ(scaled.joints[1].axes[0].function.scale, 1);
}

// A moving point stretches with its body at every angle, as a fixed one would.
TEST(ApplyScale, MovingPointsStretchAxisByAxisAndKeepTheirCoordinate) {
  ModelSpec spec = makeRod();
  PathPointSpec& point = spec.muscles[0].path[1];
  point.kind = PathPointSpec::Kind::kMoving;
  point.coordinate = "angle";
  point.location_functions[0] = {FunctionSpec::Kind::kLinear, {}, {1, 0}, 1};
  point.location_functions[1] = {FunctionSpec::Kind::kConstant, {}, {-0.4}, 0.5};
  PathPointSpec via{"rod", {0.1, -0.2, 0.3}};
  via.kind = PathPointSpec::Kind::kConditional;
  via.coordinate = "angle";
  via.range_min = -0.3;
  via.range_max = 0.2;
  spec.muscles[0].path.insert(spec.muscles[0].path.begin() + 1, via);
  const ModelSpec scaled = applyScaleFactors(spec, {{"rod", {2, 3, 4}}}, kPreserved);
  const PathPointSpec& moved = scaled.muscles[0].path[2];
  EXPECT_EQ(moved.coordinate, "angle");
  EXPECT_EQ(moved.location_functions[0].scale, 2);
  EXPECT_EQ(moved.location_functions[1].scale, 1.5);
  EXPECT_EQ(moved.location_functions[2].scale, 4);
  const PathPointSpec& stretched = scaled.muscles[0].path[1];
  EXPECT_TRUE(stretched.location.isApprox(Eigen::Vector3d(0.2, -0.6, 1.2), 1e-14));
  EXPECT_EQ(stretched.range_min, -0.3);
  EXPECT_EQ(stretched.range_max, 0.2);
}

TEST(ApplyScale, UnknownBodyIsRefused) {
  try {
    applyScaleFactors(makeRod(), {{"femur", {1, 1, 1}}}, kPreserved);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kModelReference);
    EXPECT_EQ(error.where().field, "femur");
  }
}

// Every radius grows with its own axis, as the body stretches it.
TEST(ApplyScale, SpheresAndEllipsoidsGrowWithTheirAxes) {
  ModelSpec spec = makePendulum(1.0, 0.5);
  WrapObjectSpec ball;
  ball.name = "ball";
  ball.kind = WrapObjectSpec::Kind::kSphere;
  ball.radius = 0.03;
  WrapObjectSpec egg;
  egg.name = "egg";
  egg.kind = WrapObjectSpec::Kind::kEllipsoid;
  egg.semi_axes = {0.01, 0.02, 0.03};
  egg.rotation = {0, 0, kPi / 2};  // its x along the body's y
  egg.translation = {0.1, 0.2, 0.3};
  spec.bodies[0].wrap_objects = {ball, egg};
  PassiveForceSpec bushing;
  bushing.name = "bushing";
  bushing.kind = PassiveForceSpec::Kind::kBushing;
  bushing.frame1 = {"ground", {1, 1, 1}, {0, 0, 0}};
  bushing.frame2 = {"bob", {0.1, 0.2, 0.3}, {0, 0, 0}};
  spec.passive_forces = {bushing};
  const ModelSpec scaled =
      applyScaleFactors(spec, {{"bob", {1.1, 1.2, 1.3}}}, MassDistribution::kPreserved);
  const std::vector<WrapObjectSpec>& wraps = scaled.bodies[0].wrap_objects;
  EXPECT_NEAR(wraps[0].radius, 0.03 * 1.2, tol(1e-15));
  EXPECT_LT((wraps[1].semi_axes - Eigen::Vector3d(0.012, 0.022, 0.039)).norm(), tol(1e-15));
  EXPECT_LT((wraps[1].translation - Eigen::Vector3d(0.11, 0.24, 0.39)).norm(), tol(1e-15));
  EXPECT_EQ(scaled.passive_forces[0].frame1.translation, Eigen::Vector3d(1, 1, 1));
  EXPECT_LT(
      (scaled.passive_forces[0].frame2.translation - Eigen::Vector3d(0.11, 0.24, 0.39)).norm(),
      tol(1e-15));
}

}  // namespace
}  // namespace gaitmill

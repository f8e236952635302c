#include "core/data/model_spec.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

JointSpec makeKneeLikeJoint() {
  JointSpec joint;
  joint.name = "knee";
  joint.kind = JointSpec::Kind::kCustom;
  joint.coordinates.push_back({"knee_angle"});
  joint.axes[0] = {
      "knee_angle", Eigen::Vector3d::UnitX(), {FunctionSpec::Kind::kLinear, {}, {1, 0}, 1}};
  joint.axes[3] = {
      "knee_angle", Eigen::Vector3d::UnitY(), {FunctionSpec::Kind::kSimmSpline, {0, 1}, {0, 1}, 1}};
  return joint;
}

TEST(ModelSpec, KneeThatDrivesOneAxisLinearlyIsRotational) {
  EXPECT_EQ(findMotionKind(makeKneeLikeJoint(), "knee_angle"), MotionKind::kRotational);
}

TEST(ModelSpec, CoordinateThatDrivesOnlySplinesIsCoupled) {
  JointSpec joint = makeKneeLikeJoint();
  joint.axes[0].function.kind = FunctionSpec::Kind::kSimmSpline;
  EXPECT_EQ(findMotionKind(joint, "knee_angle"), MotionKind::kCoupled);
}

TEST(ModelSpec, TotalMassScalesInertiaOnlyWhenAsked) {
  ModelSpec spec;
  spec.bodies = {{"a", 1.0, {}, {1, 2, 3, 0, 0, 0}, {}}, {"b", 3.0, {}, {4, 5, 6, 0, 0, 0}, {}}};
  ModelSpec kept = spec;
  setTotalMass(spec, 8.0, InertiaScaling::kWithMass);
  setTotalMass(kept, 8.0, InertiaScaling::kKeep);
  EXPECT_NEAR(spec.calcTotalMass(), 8.0, tol(1e-15));
  EXPECT_NEAR(spec.bodies[1].inertia[2], 12.0, tol(1e-15));
  EXPECT_NEAR(kept.bodies[1].mass, 6.0, tol(1e-15));
  EXPECT_EQ(kept.bodies[1].inertia[2], 6.0);
}

TEST(ModelSpec, NonPositiveMassIsRefused) {
  ModelSpec spec;
  spec.bodies = {{"a", 1.0, {}, {}, {}}};
  EXPECT_THROW(setTotalMass(spec, 0.0, InertiaScaling::kKeep), Error);
}

}  // namespace
}  // namespace gaitmill

#include "core/model/external_loads.h"

#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/model_files.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

using Eigen::Vector3d;

/// A foot that is loaded in the first half of the record. Unloaded, its centre of pressure runs off
/// to hundreds of metres, as extrapolated ones do.
GroundReaction makeHalfLoadedRecord(int rows = 21) {
  GroundReaction reaction;
  ExternalForce foot;
  foot.name = "ground_force_r";
  foot.body = "calcn_r";
  foot.force = Eigen::Matrix3Xd::Zero(3, rows);
  foot.point = Eigen::Matrix3Xd::Constant(3, rows, 346.0);
  foot.torque = Eigen::Matrix3Xd::Zero(3, rows);
  for (int i = 0; i < rows; ++i) {
    reaction.time.push_back(0.01 * i);
    if (i < rows / 2) {
      foot.force.col(i) = Vector3d(10, 700 + i, -5);
      foot.point.col(i) = Vector3d(0.2 + 0.01 * i, 0, 0.1);
      foot.torque.col(i) = Vector3d(0, 3, 0);
    }
  }
  reaction.forces = {foot};
  return reaction;
}

TEST(ExternalLoads, GiveForceAndMomentAboutTheGroundOriginAtTheRows) {
  const Model model(readOwnModel());
  const GroundReaction reaction = makeHalfLoadedRecord();
  const ExternalLoads loads(model, reaction);
  std::vector<BodyWrench> wrenches;
  loads.calc(0.05, wrenches);
  ASSERT_EQ(wrenches.size(), 1U);
  EXPECT_EQ(wrenches[0].body, model.getBody("calcn_r"));
  const ExternalForce& foot = reaction.forces[0];
  const Vector3d F = foot.force.col(5);
  const Vector3d moment = Vector3d(foot.point.col(5)).cross(F) + Vector3d(foot.torque.col(5));
  EXPECT_LT((wrenches[0].wrench.head<3>() - moment).norm(), tol(1e-9));
  EXPECT_LT((wrenches[0].wrench.tail<3>() - F).norm(), tol(1e-9));
}

TEST(ExternalLoads, CentreOfPressureOfAnUnloadedPlateIsNeverTouched) {
  const Model model(readOwnModel());
  GroundReaction wild = makeHalfLoadedRecord();
  GroundReaction tame = wild;
  tame.forces[0].point.rightCols(11).setZero();
  const ExternalLoads a(model, wild);
  const ExternalLoads b(model, tame);
  std::vector<BodyWrench> left, right;
  for (double t = 0; t <= 0.2; t += 0.0037) {
    a.calc(t, left);
    b.calc(t, right);
    EXPECT_EQ((left[0].wrench - right[0].wrench).norm(), 0.0) << t;
  }
}

TEST(ExternalLoads, AreZeroOutsideTheRecord) {
  const Model model(readOwnModel());
  const ExternalLoads loads(model, makeHalfLoadedRecord());
  std::vector<BodyWrench> wrenches;
  for (const double t : {-0.001, 0.2001}) {
    loads.calc(t, wrenches);
    EXPECT_EQ(wrenches[0].wrench.norm(), 0.0) << t;
  }
}

TEST(ExternalLoads, WithoutForcesThereAreNone) {
  const Model model(readOwnModel());
  const ExternalLoads loads(model, GroundReaction{});
  std::vector<BodyWrench> wrenches(3);
  loads.calc(0.0, wrenches);
  EXPECT_EQ(loads.count(), 0);
  EXPECT_TRUE(wrenches.empty());
}

TEST(ExternalLoads, UnusableRecordsAreRefused) {
  const Model model(readOwnModel());
  EXPECT_THROW(ExternalLoads(model, makeHalfLoadedRecord(3)), Error);
  GroundReaction unknown = makeHalfLoadedRecord();
  unknown.forces[0].body = "calcn_x";
  EXPECT_THROW(ExternalLoads(model, unknown), Error);
  GroundReaction ragged = makeHalfLoadedRecord();
  ragged.forces[0].torque.resize(3, 4);
  EXPECT_THROW(ExternalLoads(model, ragged), Error);
}

}  // namespace
}  // namespace gaitmill

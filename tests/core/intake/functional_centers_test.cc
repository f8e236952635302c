#include "core/intake/functional_centers.h"

#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A pelvis, a thigh and a shank with four markers each, whose hip is at kHip and whose knee turns
/// about kKneeAxis through kKnee when they stand.
const Vector3d kHip(-0.06, 0.92, 0.08);
const Vector3d kKnee(-0.05, 0.50, 0.09);
const Vector3d kKneeAxis = Vector3d(0.05, -0.03, 1).normalized();

struct Segment {
  std::vector<std::string> names;
  std::vector<Vector3d> points;
};
const Segment kPelvis{
    {"RASI", "LASI", "RPSI", "LPSI"},
    {{0.01, 1.02, 0.13}, {0.01, 1.02, -0.13}, {-0.15, 1.03, 0.05}, {-0.15, 1.03, -0.05}}};
const Segment kThigh{
    {"RTH1", "RTH2", "RTH3", "RLFC"},
    {{0.02, 0.77, 0.14}, {0.08, 0.68, 0.09}, {0.01, 0.62, 0.15}, {-0.05, 0.50, 0.14}}};
const Segment kShank{
    {"RTB1", "RTB2", "RTB3", "RLMAL"},
    {{0.0, 0.35, 0.13}, {0.04, 0.28, 0.08}, {0.0, 0.21, 0.14}, {-0.07, 0.11, 0.13}}};

/// Star and arc of the thigh by `range` rad, and a bending knee; the pelvis sways.
class Movement {
 public:
  Movement(double range, double noise) : range_(range), noise_(noise) {}

  MarkerTrajectories record(int frames) {
    MarkerTrajectories trial;
    for (const Segment* segment : {&kPelvis, &kThigh, &kShank}) {
      trial.names.insert(trial.names.end(), segment->names.begin(), segment->names.end());
    }
    trial.positions = RowMatrix(frames, 36);
    for (int frame = 0; frame < frames; ++frame) {
      trial.time.push_back(0.01 * frame);
      place(0.01 * frame, trial.positions.row(frame));
    }
    return trial;
  }

 private:
  void place(double t, Eigen::Ref<Eigen::RowVectorXd> row) {
    const Matrix3d pelvis =
        AngleAxisd(0.1 * std::sin(1.3 * t), Vector3d(0.3, 1, 0.2).normalized()).toRotationMatrix();
    const Vector3d shift(0.05 * std::sin(t), 0.01 * std::sin(2 * t), 0.02 * t);
    // Star: flexion and abduction; arc: both a quarter period apart.
    const Matrix3d thigh = pelvis * AngleAxisd(range_ * std::sin(2 * t), Vector3d::UnitZ()) *
                           AngleAxisd(range_ * std::sin(3.1 * t), Vector3d::UnitX()) *
                           AngleAxisd(0.3 * range_ * std::sin(0.7 * t), Vector3d::UnitY());
    const Matrix3d shank = thigh * AngleAxisd(-2 * range_ * (1 - std::cos(1.7 * t)), kKneeAxis);
    const Vector3d hip = pelvis * kHip + shift;
    const Vector3d knee = thigh * (kKnee - kHip) + hip;
    int column = 0;
    for (const Vector3d& p : kPelvis.points) {
      put(pelvis * p + shift, row, column);
    }
    for (const Vector3d& p : kThigh.points) {
      put(thigh * (p - kHip) + hip, row, column);
    }
    for (const Vector3d& p : kShank.points) {
      put(shank * (p - kKnee) + knee, row, column);
    }
  }
  void put(const Vector3d& point, Eigen::Ref<Eigen::RowVectorXd> row, int& column) {
    for (int axis = 0; axis < 3; ++axis) {
      row[column++] = point[axis] + noise_ * normal_(random_);
    }
  }

  double range_;  // [rad]
  double noise_;  // [m]
  std::mt19937 random_{7};
  std::normal_distribution<double> normal_{0, 1};
};

MarkerTrajectories stand() {
  return Movement(0, 0).record(1);
}

Vector3d find(const MarkerTrajectories& trial, const std::string& name) {
  return trial.position(0, *trial.findMarker(name));
}

/// Distance of a point from the axis of the knee.
double calcAxisDistance(const Vector3d& point) {
  return (point - kKnee).cross(kKneeAxis).norm();
}

TEST(RigidMotion, IsFoundAndNeverAMirror) {
  Eigen::Matrix3Xd from(3, 4);
  from << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0.001;
  const Matrix3d R = AngleAxisd(2.5, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Matrix3Xd to = (R * from).colwise() + Vector3d(1, 2, 3);
  const ClusterPose pose = fitRigidMotion(from, to).value();
  EXPECT_NEAR((pose.R - R).norm(), 0, tol(1e-9));
  EXPECT_NEAR((pose.t - Vector3d(1, 2, 3)).norm(), 0, tol(1e-9));
  EXPECT_FALSE(fitRigidMotion(from.leftCols(2), to.leftCols(2)));
}

TEST(FunctionalCenters, HipWithoutNoiseIsExact) {
  MarkerTrajectories pose = stand();
  const FunctionalTrial trial{FunctionalJoint::kRightHip, "hip.trc", Movement(0.4, 0).record(300)};
  const auto sentences = addFunctionalCenters({trial}, mapMarkerNames(pose.names), pose);
  EXPECT_NEAR((find(pose, "RHJC") - kHip).norm(), 0, tol(1e-9)) << sentences[0];
  EXPECT_NE(sentences[0].find("is 'RHJC'"), std::string::npos);
}

// 2 mm of white noise on every marker coordinate: far more than cameras have. The bound is four
// standard deviations over seeds.
TEST(FunctionalCenters, HipWithNoiseIsGoodToMillimetres) {
  MarkerTrajectories pose = stand();
  const FunctionalTrial trial{
      FunctionalJoint::kRightHip, "hip.trc", Movement(0.4, 0.002).record(600)};
  addFunctionalCenters({trial}, mapMarkerNames(pose.names), pose);
  EXPECT_NEAR((find(pose, "RHJC") - kHip).norm(), 0, tol(0.003));
}

TEST(FunctionalCenters, KneeIsOnItsAxis) {
  MarkerTrajectories pose = stand();
  const FunctionalTrial trial{
      FunctionalJoint::kRightKnee, "knee.trc", Movement(0.3, 0.001).record(400)};
  const auto sentences = addFunctionalCenters({trial}, mapMarkerNames(pose.names), pose);
  ASSERT_TRUE(pose.findMarker("RKJC")) << sentences[0];
  EXPECT_NEAR(calcAxisDistance(find(pose, "RKJC")), 0, tol(0.002));
  // Nearest to the lateral condyle, which is 5 cm out.
  EXPECT_NEAR((find(pose, "RKJC") - Vector3d(-0.05, 0.50, 0.14)).norm(), 0, tol(0.01));
}

TEST(FunctionalCenters, HingeAxisIsFound) {
  std::vector<ClusterPose> still(200), turning(200);
  for (std::size_t i = 0; i < turning.size(); ++i) {
    turning[i].R = AngleAxisd(0.01 * static_cast<double>(i), kKneeAxis).toRotationMatrix();
    turning[i].t = kKnee - turning[i].R * kKnee;
  }
  const JointEstimate joint =
      estimateJoint(still, turning, kKnee + Vector3d(0, 0, 0.1), true).value();
  EXPECT_NEAR(std::abs(joint.axis.dot(kKneeAxis)), 1, tol(1e-9));
  EXPECT_NEAR(calcAxisDistance(joint.center), 0, tol(1e-9));
  EXPECT_NEAR(joint.residual, 0, tol(1e-9));
}

TEST(FunctionalCenters, WhatIsMeasuredIsReplaced) {
  MarkerTrajectories pose = stand();
  pose.names.push_back("R_HJC");
  pose.positions.conservativeResize(Eigen::NoChange, 39);
  pose.positions.rightCols(3).setZero();
  const FunctionalTrial trial{FunctionalJoint::kRightHip, "hip.trc", Movement(0.4, 0).record(300)};
  const MarkerMapping mapping = mapMarkerNames(pose.names, {{"R_HJC", "RHJC"}});
  addFunctionalCenters({trial}, mapping, pose);
  EXPECT_FALSE(pose.findMarker("RHJC"));
  EXPECT_NEAR((find(pose, "R_HJC") - kHip).norm(), 0, tol(1e-9));
}

TEST(FunctionalCenters, TooLittleMovementAndTooFewMarkersAreRefused) {
  MarkerTrajectories pose = stand();
  const MarkerMapping mapping = mapMarkerNames(pose.names);
  const FunctionalTrial still{
      FunctionalJoint::kRightHip, "still.trc", Movement(0.02, 0).record(300)};
  const FunctionalTrial left{FunctionalJoint::kLeftHip, "left.trc", Movement(0.4, 0).record(300)};
  const auto sentences = addFunctionalCenters({still, left}, mapping, pose);
  EXPECT_NE(sentences[0].find("turns too little"), std::string::npos) << sentences[0];
  EXPECT_NE(sentences[1].find("only 0 frames"), std::string::npos) << sentences[1];
  EXPECT_FALSE(pose.findMarker("RHJC"));
}

TEST(FunctionalCenters, SlippingMarkersAreRefused) {
  MarkerTrajectories pose = stand();
  const FunctionalTrial trial{
      FunctionalJoint::kRightHip, "slip.trc", Movement(0.4, 0.04).record(300)};
  const auto sentences = addFunctionalCenters({trial}, mapMarkerNames(pose.names), pose);
  EXPECT_NE(sentences[0].find("the markers slip"), std::string::npos) << sentences[0];
}

}  // namespace
}  // namespace gaitmill

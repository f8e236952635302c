#include "core/scale/virtual_markers.h"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

using Eigen::Vector3d;

// Numbers of spec/scale.md 6.1: width 0.2569 m and depth 0.2081 m put the centres at
// (-0.0598, -0.0880, +-0.0921) m from mid ASIS.
TEST(HipCenter, RegressionOfHarringtonInAnyOrientation) {
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(1.9, Vector3d(0.2, 0.9, -0.4).normalized()).toRotationMatrix();
  const Vector3d middle(0.3, 1.1, -0.2);
  const PelvisPoints pelvis{middle + R * Vector3d(0, 0, 0.12845),
                            middle - R * Vector3d(0, 0, 0.12845),
                            middle - R * Vector3d(0.2081, 0, 0)};
  const Vector3d right = R.transpose() * (calcHipCenter(pelvis, true).value() - middle);
  const Vector3d left = R.transpose() * (calcHipCenter(pelvis, false).value() - middle);
  EXPECT_NEAR((right - Vector3d(-0.0598, -0.0880, 0.0921)).norm(), 0, tol(1e-4));
  EXPECT_NEAR((left - Vector3d(right.x(), right.y(), -right.z())).norm(), 0, tol(1e-12));
}

TEST(HipCenter, PointsInALineHaveNone) {
  EXPECT_FALSE(calcHipCenter({{0, 0, 1}, {0, 0, -1}, {0, 0, 0.5}}, true));
}

class VirtualMarkers : public ::testing::Test {
 protected:
  VirtualMarkers() {
    trial_.names = {"A", "B"};
    trial_.time = {0, 0.1};
    trial_.positions = RowMatrix(2, 6);
    trial_.positions << 0, 0, 0, 1, 2, 3, 1, 1, 1, std::numeric_limits<double>::quiet_NaN(), 0, 0;
  }
  MarkerTrajectories trial_;
};

TEST_F(VirtualMarkers, MeanFollowsItsSourcesAndIsMissingWithThem) {
  addVirtualMarkers({{"middle", VirtualMarkerSpec::Rule::kMean, {"A", "B"}}}, trial_);
  ASSERT_EQ(trial_.names.back(), "middle");
  EXPECT_EQ(trial_.position(0, 2), Vector3d(0.5, 1, 1.5));
  EXPECT_TRUE(trial_.isMissing(1, 2));
  EXPECT_EQ(trial_.position(1, 0), Vector3d(1, 1, 1));
}

TEST_F(VirtualMarkers, MeasuredPointsStayAndUnknownSourcesGiveNone) {
  addVirtualMarkers({{"B", VirtualMarkerSpec::Rule::kMean, {"A"}},
                     {"C", VirtualMarkerSpec::Rule::kMean, {"A", "Z"}}},
                    trial_);
  EXPECT_EQ(trial_.names.size(), 2U);
  EXPECT_EQ(trial_.position(0, 1), Vector3d(1, 2, 3));
}

TEST_F(VirtualMarkers, HipCentreOfTwoPointsIsRefused) {
  try {
    addVirtualMarkers({{"H", VirtualMarkerSpec::Rule::kRightHipCenter, {"A", "B"}}}, trial_);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInputMarkers);
  }
}

}  // namespace
}  // namespace gaitmill

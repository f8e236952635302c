#include "core/render/camera.h"

#include <algorithm>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr Frame kFrame{20, 10, 620, 350};

std::vector<Eigen::Vector3f> makeCloud() {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> at(-1, 1);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 400; ++i) {
    points.push_back({0.5F * at(random), 0.9F + 0.9F * at(random), 0.3F * at(random)});
  }
  return points;
}

class CameraView : public ::testing::TestWithParam<View> {};

TEST_P(CameraView, ShowsEveryPointAndFillsTheFrame) {
  const std::vector<Eigen::Vector3f> points = makeCloud();
  const Eigen::Vector3d follow(3, 0, -2);
  const Framing framing = fitFraming(points, GetParam(), kFrame);
  const Camera camera = makeCamera(GetParam(), framing, kFrame, follow);
  double least = 1e9;  // [px] between a point and the frame
  for (const Eigen::Vector3f& p : points) {
    const Eigen::Vector3d pixel = camera.project(p.cast<double>() + follow);
    EXPECT_GT(pixel.z(), camera.near_depth);
    EXPECT_LT(pixel.z(), camera.far_depth);
    least = std::min({least,
                      pixel.x() - kFrame.left,
                      kFrame.right - pixel.x(),
                      pixel.y() - kFrame.top,
                      kFrame.bottom - pixel.y()});
  }
  EXPECT_NEAR(least, 0, tol(1e-3));  // the outermost point touches: the points are floats
}

TEST_P(CameraView, ClipCoordinatesOfATileAgreeWithThePixels) {
  const Camera camera = makeCamera(GetParam(), {{0, 0.9, 0}, 6}, kFrame, {1, 0, 1});
  const Eigen::Vector3d point(1.3, 1.4, 0.8);
  const Eigen::Vector4d clip = camera.calcClipMatrix(100, 50, 300, 200) * point.homogeneous();
  const Eigen::Vector3d pixel = camera.project(point);
  EXPECT_NEAR(100 + 300 * (0.5 + 0.5 * clip.x() / clip.w()), pixel.x(), tol(1e-9));
  EXPECT_NEAR(50 + 200 * (0.5 - 0.5 * clip.y() / clip.w()), pixel.y(), tol(1e-9));
}

INSTANTIATE_TEST_SUITE_P(Views,
                         CameraView,
                         ::testing::Values(View{0, 0},
                                           View{0.5 * kPi, 0},
                                           View{0.7, 0.2},
                                           View{-2.5, -0.6},
                                           View{0.3, 0.5 * kPi}));

TEST(Camera, SagittalViewShowsForwardToTheRightAndUpUpwards) {
  const Camera camera = makeCamera({0, 0}, {{0, 1, 0}, 5}, kFrame, {0, 0, 0});
  const Eigen::Vector3d middle = camera.project({0, 1, 0});
  EXPECT_NEAR(middle.x(), 320, tol(1e-9));
  EXPECT_NEAR(middle.y(), 180, tol(1e-9));
  EXPECT_GT(camera.project({0.1, 1, 0}).x(), middle.x());
  EXPECT_LT(camera.project({0, 1.1, 0}).y(), middle.y());
  EXPECT_LT(camera.project({0, 1, 0.1}).z(), middle.z());  // the right side is nearer
}

TEST(Camera, FrontalViewShowsTheRightSideOnTheLeft) {
  const Camera camera = makeCamera({0.5 * kPi, 0}, {{0, 1, 0}, 5}, kFrame, {0, 0, 0});
  EXPECT_LT(camera.project({0, 1, 0.1}).x(), 320);
  EXPECT_LT(camera.project({0.1, 1, 0}).z(), 5);  // the front is nearer
}

TEST(Camera, ViewsFromBothSidesMirrorEachOther) {
  const Camera right = makeCamera({0, 0}, {{0, 1, 0}, 5}, kFrame, {0, 0, 0});
  const Camera left = makeCamera({kPi, 0}, {{0, 1, 0}, 5}, kFrame, {0, 0, 0});
  const Eigen::Vector3d point(0.4, 1.3, 0.2), mirrored(0.4, 1.3, -0.2);
  const Eigen::Vector3d a = right.project(point), b = left.project(mirrored);
  EXPECT_NEAR(a.x() - 320, 320 - b.x(), tol(1e-9));
  EXPECT_NEAR(a.y(), b.y(), tol(1e-9));
}

TEST(Framing, OfNothingIsStillAFraming) {
  const Framing framing = fitFraming({}, {}, kFrame);
  EXPECT_GT(framing.distance, 0);
}

}  // namespace
}  // namespace gaitmill

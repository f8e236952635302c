#include "core/render/camera.h"

#include <algorithm>
#include <cmath>

namespace gaitmill {

namespace {

// Tangent of half the vertical field of view: a long lens (17 degrees), whose pictures are almost
// parallel projections, as published figures are, but still show which leg is nearer.
constexpr double kHalfHeight = 0.15;

Eigen::Matrix3d calcAxes(const View& view) {
  const double ca = std::cos(view.azimuth), sa = std::sin(view.azimuth);
  const double ce = std::cos(view.elevation), se = std::sin(view.elevation);
  Eigen::Matrix3d R_CG;
  R_CG.row(0) << ca, 0, -sa;
  R_CG.row(1) << -sa * se, ce, -ca * se;
  R_CG.row(2) << sa * ce, se, ca * ce;
  return R_CG;
}

}  // namespace

Eigen::Vector3d Camera::project(const Eigen::Vector3d& p_G) const {
  const Eigen::Vector3d p_C = R_CG * (p_G - eye);
  const double depth = -p_C.z();
  return {center.x() + focal_length * p_C.x() / depth,
          center.y() - focal_length * p_C.y() / depth,
          depth};
}

Eigen::Matrix4d Camera::calcClipMatrix(int left, int top, int width, int height) const {
  // Rows are those of the usual perspective matrix, with the principal point moved off the middle.
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  clip(0, 0) = 2 * focal_length / width;
  clip(0, 2) = 1 - 2 * (center.x() - left) / width;
  clip(1, 1) = 2 * focal_length / height;
  clip(1, 2) = 2 * (center.y() - top) / height - 1;
  clip(2, 2) = -(far_depth + near_depth) / (far_depth - near_depth);
  clip(2, 3) = -2 * far_depth * near_depth / (far_depth - near_depth);
  clip(3, 2) = -1;
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.topLeftCorner<3, 3>() = R_CG;
  view.topRightCorner<3, 1>() = -R_CG * eye;
  return clip * view;
}

double findFocalLength(const Frame& frame) {
  return 0.5 * (frame.bottom - frame.top) / kHalfHeight;
}

Framing fitFraming(const std::vector<Eigen::Vector3f>& points,
                   const View& view,
                   const Frame& frame) {
  const Eigen::Matrix3d R_CG = calcAxes(view);
  const double focal = findFocalLength(frame);
  const double half_width = 0.5 * (frame.right - frame.left) / focal;
  Eigen::Vector3d lowest = Eigen::Vector3d::Constant(1e30), highest = -lowest;
  for (const Eigen::Vector3f& p : points) {
    const Eigen::Vector3d p_C = R_CG * p.cast<double>();
    lowest = lowest.cwiseMin(p_C);
    highest = highest.cwiseMax(p_C);
  }
  Framing framing;
  if (points.empty()) return framing;
  const Eigen::Vector3d aim_C = 0.5 * (lowest + highest);
  framing.aim = R_CG.transpose() * aim_C;
  // A point is inside if |x| <= tan(half angle) (distance - z), from the aim in camera axes.
  for (const Eigen::Vector3f& p : points) {
    const Eigen::Vector3d d = R_CG * p.cast<double>() - aim_C;
    framing.distance = std::max({framing.distance,
                                 d.z() + std::abs(d.x()) / half_width,
                                 d.z() + std::abs(d.y()) / kHalfHeight});
  }
  return framing;
}

Camera makeCamera(const View& view,
                  const Framing& framing,
                  const Frame& frame,
                  const Eigen::Vector3d& follow) {
  Camera camera;
  camera.R_CG = calcAxes(view);
  camera.eye = follow + framing.aim + framing.distance * camera.R_CG.row(2).transpose();
  camera.focal_length = findFocalLength(frame);
  camera.center = {0.5 * (frame.left + frame.right), 0.5 * (frame.top + frame.bottom)};
  camera.near_depth = 0.2 * framing.distance;
  camera.far_depth = 4 * framing.distance;
  return camera;
}

}  // namespace gaitmill

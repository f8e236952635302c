#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/render/picture.h"

namespace gaitmill {

/// A pinhole camera whose image plane is measured in pixels, so that what is drawn over a picture
/// (labels, arrows of the legend) and what is drawn in it agree by construction.
struct Camera {
  Eigen::Matrix3d R_CG = Eigen::Matrix3d::Identity();  ///< rows: right, up, towards the viewer
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();       ///< in ground [m]
  double focal_length = 1;                             ///< [px]
  Eigen::Vector2d center = Eigen::Vector2d::Zero();    ///< where the axis meets the image [px]
  double near_depth = 0.1;                             ///< [m] in front of the eye
  double far_depth = 100;

  /// Pixel of a point, x to the right and y DOWN from the upper left corner; z is its depth [m].
  Eigen::Vector3d project(const Eigen::Vector3d& p_G) const;
  /// Homogeneous clip coordinates (OpenGL) of the part of the image that begins at (left, top).
  Eigen::Matrix4d calcClipMatrix(int left, int top, int width, int height) const;
};

/// Part of an image that the body may fill [px].
struct Frame {
  double left = 0;
  double top = 0;
  double right = 0;
  double bottom = 0;
};

/// How far a camera stands from the subject and where it aims: the same for all poses of a motion,
/// so that pictures of one motion compare.
struct Framing {
  Eigen::Vector3d aim = Eigen::Vector3d::Zero();  ///< seen in the middle, from the ground below the
                                                  ///< pelvis [m]
  double distance = 1;                            ///< of the eye from the aim [m]
};

/// The closest framing that shows every point.
/// @param points  of the body at all times, from the ground below the pelvis, ground axes [m]
Framing fitFraming(const std::vector<Eigen::Vector3f>& points,
                   const View& view,
                   const Frame& frame);

/// Distance of the image plane from the eye [px]: pixels per metre, times the depth.
double findFocalLength(const Frame& frame);

/// @param follow  ground below the pelvis [m]
Camera makeCamera(const View& view,
                  const Framing& framing,
                  const Frame& frame,
                  const Eigen::Vector3d& follow);

}  // namespace gaitmill

#pragma once

#include <string>

#include <Eigen/Core>

namespace gaitmill {

/// How one straight segment meets a surface.
struct WrapContact {
  enum class Status {
    kNone,       ///< passes by: straight
    kInside,     ///< an end lies inside the surface: straight
    kMandatory,  ///< the straight line cuts the surface: the first segment that does wraps
    kWrapped,    ///< may wrap: of several segments the one with the least detour does
  };
  Status status = Status::kNone;
  Eigen::Vector3d r1 = Eigen::Vector3d::Zero();  ///< tangent points, in the surface's frame [m]
  Eigen::Vector3d r2 = Eigen::Vector3d::Zero();
  double surface_length = 0;  ///< of the path between them [m]
  double turn = 0;            ///< cylinders: signed angle travelled from r1 to r2 about z [rad]

  bool wraps() const { return status == Status::kMandatory || status == Status::kWrapped; }
};

/// The half space sign * coordinate >= 0 in which a path must stay; axis −1 = unconstrained.
struct HalfSpace {
  int axis = -1;
  double sign = 1;

  bool holds(const Eigen::Vector3d& p) const {
    return axis < 0 || (p[axis] >= 0 ? 1.0 : -1.0) == sign;
  }
};

/// "all" or empty = unconstrained, else an axis such as "x", "+y", "-Z".
/// @throws Error kModelValue naming the wrap object
HalfSpace parseQuadrant(const std::string& quadrant, const std::string& wrap_object);

}  // namespace gaitmill

#pragma once

#include <Eigen/Core>

#include "core/data/model_spec.h"

namespace gaitmill {

/// A wrap cylinder in its own frame: axis = z through the origin. `axis` and `sign` name the half
/// space sign * coordinate >= 0 in which the path must stay; axis −1 = unconstrained.
struct WrapCylinder {
  double radius = 1;
  double length = 1;
  int axis = -1;
  double sign = 1;
};

/// @throws Error kModelValue for an unknown quadrant or a negative radius
WrapCylinder makeWrapCylinder(const WrapCylinderSpec& spec);

/// How one straight segment meets a cylinder.
struct WrapContact {
  enum class Status {
    kNone,       ///< passes by: straight
    kInside,     ///< an end lies inside the cylinder: straight
    kMandatory,  ///< the straight line cuts the cylinder
    kWrapped,    ///< dragged over by the half-space constraint
  };
  Status status = Status::kNone;
  Eigen::Vector3d r1 = Eigen::Vector3d::Zero();  ///< tangent points, in the cylinder's frame [m]
  Eigen::Vector3d r2 = Eigen::Vector3d::Zero();
  double surface_length = 0;  ///< of the helix between them [m]
  double turn = 0;            ///< signed angle travelled from r1 to r2 about z [rad]

  bool wraps() const { return status == Status::kMandatory || status == Status::kWrapped; }
};

/// Shortest path from P1 to P2 over the cylinder, as a geodesic in closed form: two tangents and a
/// helix, a straight line once the surface is unrolled (spec/path.md 5.1 to 5.4).
WrapContact calcWrapContact(const WrapCylinder& cylinder,
                            const Eigen::Vector3d& P1,
                            const Eigen::Vector3d& P2);

}  // namespace gaitmill

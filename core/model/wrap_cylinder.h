#pragma once

#include <Eigen/Core>

#include "core/data/model_spec.h"
#include "core/model/wrap_contact.h"

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
WrapCylinder makeWrapCylinder(const WrapObjectSpec& spec);

/// Shortest path from P1 to P2 over the cylinder, as a geodesic in closed form: two tangents and a
/// helix, a straight line once the surface is unrolled (spec/path.md 5.1 to 5.4).
WrapContact calcWrapContact(const WrapCylinder& cylinder,
                            const Eigen::Vector3d& P1,
                            const Eigen::Vector3d& P2);

}  // namespace gaitmill

#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/data/model_spec.h"
#include "core/model/wrap_contact.h"

namespace gaitmill {

/// An ellipsoid about the origin of its own frame, its axes along the frame's.
struct WrapEllipsoid {
  Eigen::Vector3d semi_axes = Eigen::Vector3d::Ones();
  HalfSpace half_space;
  int steps = 0;  ///< of the integration of one geodesic: more where the axes differ much
};

/// @throws Error kModelValue for an unknown quadrant or an axis that is not positive
WrapEllipsoid makeWrapEllipsoid(const WrapObjectSpec& spec);

/// Locally shortest path from P1 to P2 over the ellipsoid: a geodesic between two tangents. It
/// wraps wherever the straight line cuts the ellipsoid, on the side where the line is nearer to the
/// surface; with a half space, on the side where its crest is in it.
///
/// The geodesic is shot from the circle of points that P1 sees edge-on, and turned on that circle
/// until its tangent meets P2 (Newton with the Jacobi field of the neighbouring geodesics). So
/// lengths are smooth in P1 and P2 and tangent directions are their derivatives, to some 1e-9.
/// OpenSim instead lays a plane through P1, P2 and a point of the surface, and sums chords; its
/// paths are longer by up to millimetres, and jitter (spec/path.md 7).
///
/// Where a half space asks for a side that has no geodesic, the path is the plane's section there;
/// its directions are then those of the section, not the derivatives of its length.
WrapContact calcWrapContact(const WrapEllipsoid& ellipsoid,
                            const Eigen::Vector3d& P1,
                            const Eigen::Vector3d& P2);

/// Appends `count` points that divide the path of a contact into equal steps, ends excluded.
void traceSurface(const WrapEllipsoid& ellipsoid,
                  const Eigen::Vector3d& P1,
                  const WrapContact& contact,
                  int count,
                  std::vector<Eigen::Vector3d>& points);

}  // namespace gaitmill

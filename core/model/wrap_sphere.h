#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/data/model_spec.h"
#include "core/model/wrap_contact.h"

namespace gaitmill {

/// A sphere about the origin of its own frame.
struct WrapSphere {
  double radius = 1;
  HalfSpace half_space;
};

/// @throws Error kModelValue for an unknown quadrant or a radius that is not positive
WrapSphere makeWrapSphere(const WrapObjectSpec& spec);

/// Shortest path from P1 to P2 over the sphere, in closed form: two tangents and an arc of a great
/// circle, all in the plane of P1, P2 and the centre (spec/path.md 7). Where the straight line runs
/// through the centre every plane is as good; one is chosen by the axes.
WrapContact calcWrapContact(const WrapSphere& sphere,
                            const Eigen::Vector3d& P1,
                            const Eigen::Vector3d& P2);

/// Appends `count` points that divide the path of a contact into equal steps, ends excluded.
void traceSurface(const WrapSphere& sphere,
                  const Eigen::Vector3d& P1,
                  const WrapContact& contact,
                  int count,
                  std::vector<Eigen::Vector3d>& points);

}  // namespace gaitmill

#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/data/model_spec.h"
#include "core/model/wrap_contact.h"
#include "core/model/wrap_cylinder.h"
#include "core/model/wrap_ellipsoid.h"
#include "core/model/wrap_sphere.h"

namespace gaitmill {

/// A wrap object of any kind, in its own frame; the member of its kind is in use.
struct WrapSurface {
  WrapObjectSpec::Kind kind = WrapObjectSpec::Kind::kCylinder;
  WrapCylinder cylinder;
  WrapSphere sphere;
  WrapEllipsoid ellipsoid;
};

/// @throws Error kModelValue for an unknown quadrant or a size that is not positive
WrapSurface makeWrapSurface(const WrapObjectSpec& spec);

/// Path of one straight segment over the surface, as its kind defines it. Does not allocate.
WrapContact calcWrapContact(const WrapSurface& surface,
                            const Eigen::Vector3d& P1,
                            const Eigen::Vector3d& P2);

}  // namespace gaitmill

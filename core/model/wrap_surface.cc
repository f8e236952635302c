#include "core/model/wrap_surface.h"

namespace gaitmill {

WrapSurface makeWrapSurface(const WrapObjectSpec& spec) {
  WrapSurface surface;
  surface.kind = spec.kind;
  switch (spec.kind) {
    case WrapObjectSpec::Kind::kCylinder:
      surface.cylinder = makeWrapCylinder(spec);
      break;
    case WrapObjectSpec::Kind::kSphere:
      surface.sphere = makeWrapSphere(spec);
      break;
    case WrapObjectSpec::Kind::kEllipsoid:
      surface.ellipsoid = makeWrapEllipsoid(spec);
      break;
  }
  return surface;
}

WrapContact calcWrapContact(const WrapSurface& surface,
                            const Eigen::Vector3d& P1,
                            const Eigen::Vector3d& P2) {
  switch (surface.kind) {
    case WrapObjectSpec::Kind::kSphere:
      return calcWrapContact(surface.sphere, P1, P2);
    case WrapObjectSpec::Kind::kEllipsoid:
      return calcWrapContact(surface.ellipsoid, P1, P2);
    case WrapObjectSpec::Kind::kCylinder:
      break;
  }
  return calcWrapContact(surface.cylinder, P1, P2);
}

}  // namespace gaitmill

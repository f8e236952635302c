#include "core/model/wrap_sphere.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Geometry>

#include "core/base/error.h"
#include "core/base/units.h"

namespace gaitmill {

namespace {

using Eigen::Vector3d;
using Status = WrapContact::Status;

/// Where the line P1P2 comes closest to the centre.
struct ClosestApproach {
  Vector3d foot = Vector3d::Zero();
  bool hits = false;  ///< inside the sphere, strictly between the ends
};

ClosestApproach findClosestApproach(double radius, const Vector3d& P1, const Vector3d& P2) {
  const Vector3d d = P2 - P1;
  const double d2 = d.squaredNorm();
  ClosestApproach approach;
  if (d2 > 0) {
    const double t = -P1.dot(d) / d2;
    approach.foot = P1 + t * d;
    approach.hits = approach.foot.squaredNorm() < radius * radius && t > 0 && t < 1;
  }
  return approach;
}

Status findStatus(const WrapSphere& sphere, const Vector3d& P1, const Vector3d& P2) {
  const double r2 = sphere.radius * sphere.radius;
  if (P1.squaredNorm() < r2 || P2.squaredNorm() < r2) {
    return Status::kInside;
  }
  const ClosestApproach approach = findClosestApproach(sphere.radius, P1, P2);
  if (sphere.half_space.axis < 0) {
    return approach.hits ? Status::kWrapped : Status::kNone;
  }
  const bool on1 = sphere.half_space.holds(P1);
  const bool on2 = sphere.half_space.holds(P2);
  if (!on1 && !on2) {
    return Status::kWrapped;
  }
  if (approach.hits) {
    return Status::kMandatory;
  }
  return on1 != on2 && !sphere.half_space.holds(approach.foot) ? Status::kWrapped : Status::kNone;
}

/// Normal of the plane of P1, P2 and the centre: from P1 to P2 the short way is a positive turn.
Vector3d findPlane(const Vector3d& P1, const Vector3d& P2) {
  // Sines below this leave the plane undetermined (spec/path.md 7).
  constexpr double kCollinear = 1e-5;
  const Vector3d normal = P1.cross(P2);
  if (normal.norm() > kCollinear * P1.norm() * P2.norm()) {
    return normal.normalized();
  }
  Eigen::Index least = 0;
  P1.cwiseAbs().minCoeff(&least);
  return P1.cross(Vector3d::Unit(least)).normalized();
}

/// The point where a path that leaves P touches the sphere, turning by `side` (+1 or -1) about the
/// normal.
Vector3d findTangent(double radius, const Vector3d& P, const Vector3d& normal, double side) {
  const double d2 = P.squaredNorm();
  const double c = radius * radius / d2;
  const double s = radius * std::sqrt(std::fmax(0.0, d2 - radius * radius)) / d2;
  return c * P + side * s * normal.cross(P);
}

/// Whether the path goes round the sphere on the side away from the straight line.
bool goesFar(const WrapSphere& sphere, const Vector3d& P1, const Vector3d& P2, const Vector3d& n) {
  const HalfSpace& half = sphere.half_space;
  if (half.axis < 0 || (half.holds(P1) && half.holds(P2))) {
    return false;
  }
  const Vector3d r1 = findTangent(sphere.radius, P1, n, -1);
  const Vector3d r2 = findTangent(sphere.radius, P2, n, 1);
  return half.sign * ((r1 - P1) + (r2 - P2))[half.axis] >= 0;
}

}  // namespace

WrapSphere makeWrapSphere(const WrapObjectSpec& spec) {
  require(std::isfinite(spec.radius) && spec.radius > 0,
          ErrorCode::kModelValue,
          "wrap sphere '" + spec.name + "' needs a positive radius, found " +
              std::to_string(spec.radius),
          {{}, 0, 0, spec.name});
  return {spec.radius, parseQuadrant(spec.quadrant, spec.name)};
}

WrapContact calcWrapContact(const WrapSphere& sphere, const Vector3d& P1, const Vector3d& P2) {
  WrapContact contact;
  contact.status = findStatus(sphere, P1, P2);
  if (!contact.wraps()) {
    return contact;
  }
  const Vector3d n = findPlane(P1, P2);
  const double side = goesFar(sphere, P1, P2, n) ? -1.0 : 1.0;
  contact.r1 = findTangent(sphere.radius, P1, n, side);
  contact.r2 = findTangent(sphere.radius, P2, n, -side);
  double turn = std::atan2(contact.r1.cross(contact.r2).norm(), contact.r1.dot(contact.r2));
  const bool is_long = sphere.half_space.axis >= 0 &&
                       (contact.r1 + contact.r2).dot((contact.r1 - P1) + (contact.r2 - P2)) < 0;
  turn = is_long ? 2 * kPi - turn : turn;
  contact.surface_length = sphere.radius * turn;
  return contact;
}

void traceSurface(const WrapSphere& sphere,
                  const Vector3d& P1,
                  const WrapContact& contact,
                  int count,
                  std::vector<Vector3d>& points) {
  const Vector3d ahead = (contact.r1 - P1).stableNormalized();
  for (int i = 1; i <= count; ++i) {
    const double turn = contact.surface_length / sphere.radius * i / (count + 1);
    points.push_back(std::cos(turn) * contact.r1 + sphere.radius * std::sin(turn) * ahead);
  }
}

}  // namespace gaitmill

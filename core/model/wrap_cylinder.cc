#include "core/model/wrap_cylinder.h"

#include <cmath>
#include <string>

#include "core/base/error.h"
#include "core/base/units.h"

namespace gaitmill {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double signOf(double x) {
  return x >= 0 ? 1.0 : -1.0;
}

/// Where the line P1P2 comes closest to the cylinder's axis.
struct ClosestApproach {
  bool defined = false;  ///< false for a line parallel to the axis
  bool hits = false;     ///< inside the cylinder, strictly between the ends
  Vector3d foot = Vector3d::Zero();
};

ClosestApproach findClosestApproach(double radius, const Vector3d& P1, const Vector3d& P2) {
  // |direction x z|^2 below this is parallel (spec/path.md 5.1).
  constexpr double kParallel = 2e-13;
  const Vector3d d = P2 - P1;
  const double d_xy = d.head<2>().squaredNorm();
  ClosestApproach approach;
  if (d_xy <= kParallel * d.squaredNorm()) {
    return approach;
  }
  const double t = -P1.head<2>().dot(d.head<2>()) / d_xy;
  approach.defined = true;
  approach.foot = P1 + t * d;
  approach.hits = approach.foot.head<2>().squaredNorm() < radius * radius && t > 0 && t < 1;
  return approach;
}

WrapContact::Status findStatus(const WrapCylinder& cylinder,
                               const Vector3d& P1,
                               const Vector3d& P2) {
  using Status = WrapContact::Status;
  const double r2 = cylinder.radius * cylinder.radius;
  if (P1.head<2>().squaredNorm() < r2 || P2.head<2>().squaredNorm() < r2) {
    return Status::kInside;
  }
  const ClosestApproach approach = findClosestApproach(cylinder.radius, P1, P2);
  if (cylinder.axis < 0) {
    return approach.hits ? Status::kMandatory : Status::kNone;
  }
  const double s1 = signOf(P1[cylinder.axis]);
  const double s2 = signOf(P2[cylinder.axis]);
  if (s1 != cylinder.sign && s2 != cylinder.sign) {
    return Status::kWrapped;
  }
  if (approach.hits) {
    return Status::kMandatory;
  }
  const bool crosses_inactive =
      s1 != s2 && approach.defined && signOf(approach.foot[cylinder.axis]) != cylinder.sign;
  return crosses_inactive ? Status::kWrapped : Status::kNone;
}

/// Tangent points from a point outside: `a` ahead of it, `b` behind it, counter-clockwise.
struct Tangents {
  Vector2d a;
  Vector2d b;
};

Tangents findTangents(double radius, const Vector3d& P) {
  const double rho2 = P.head<2>().squaredNorm();
  // Rotating P by +-acos(r/rho) and shortening it to r, without trigonometry.
  const double c = radius * radius / rho2;
  const double s = radius * std::sqrt(std::fmax(0.0, rho2 - radius * radius)) / rho2;
  return {{c * P.x() - s * P.y(), c * P.y() + s * P.x()},
          {c * P.x() + s * P.y(), c * P.y() - s * P.x()}};
}

/// Whether the path goes counter-clockwise, pair (a1, b2), or clockwise, pair (b1, a2).
bool chooseCounterClockwise(const WrapCylinder& cylinder, const Tangents& t1, const Tangents& t2) {
  // Cosines (times r^2) of the angles that the two candidate pairs subtend.
  const double alpha = t1.a.dot(t2.b);
  const double beta = t1.b.dot(t2.a);
  if (cylinder.axis < 0 || cylinder.axis == 2) {
    return alpha >= beta;
  }
  const auto on = [&](const Vector2d& point) {
    return signOf(point[cylinder.axis]) == cylinder.sign;
  };
  if (on(t1.a) && on(t1.b)) {
    return !on(t2.a);
  }
  if (on(t1.a)) {
    return true;
  }
  if (on(t1.b)) {
    return false;
  }
  if (on(t2.a)) {
    return false;
  }
  if (on(t2.b)) {
    return true;
  }
  return alpha < beta;
}

/// Whether a constrained wrap goes the long way round (spec/path.md 5.3): both radii and both
/// tangent segments on opposite sides.
bool isLongWrap(const WrapCylinder& cylinder,
                const Vector2d& r1,
                const Vector2d& r2,
                const Vector3d& P1,
                const Vector3d& P2) {
  return cylinder.axis >= 0 && (r1 + r2).dot((r1 - P1.head<2>()) + (r2 - P2.head<2>())) < 0;
}

}  // namespace

HalfSpace parseQuadrant(const std::string& quadrant, const std::string& wrap_object) {
  HalfSpace half;
  std::string axis_name = quadrant;
  if (axis_name.empty() || axis_name == "all" || axis_name == "Unassigned") {
    return half;
  }
  if (axis_name[0] == '+' || axis_name[0] == '-') {
    half.sign = axis_name[0] == '-' ? -1.0 : 1.0;
    axis_name.erase(0, 1);
  }
  const std::size_t axis = std::string("xyzXYZ").find(axis_name);
  require(axis_name.size() == 1 && axis != std::string::npos,
          ErrorCode::kModelValue,
          "wrap object '" + wrap_object + "' has the quadrant '" + quadrant +
              "'; expected all, or an axis such as x, +y or -z",
          {{}, 0, 0, wrap_object});
  half.axis = static_cast<int>(axis % 3);
  return half;
}

WrapCylinder makeWrapCylinder(const WrapObjectSpec& spec) {
  require(std::isfinite(spec.radius) && spec.radius > 0 && std::isfinite(spec.length),
          ErrorCode::kModelValue,
          "wrap cylinder '" + spec.name + "' needs a positive radius, found " +
              std::to_string(spec.radius),
          {{}, 0, 0, spec.name});
  const HalfSpace half = parseQuadrant(spec.quadrant, spec.name);
  return {spec.radius, spec.length, half.axis, half.sign};
}

WrapContact calcWrapContact(const WrapCylinder& cylinder, const Vector3d& P1, const Vector3d& P2) {
  WrapContact contact;
  contact.status = findStatus(cylinder, P1, P2);
  if (!contact.wraps()) {
    return contact;
  }
  const double r = cylinder.radius;
  const Tangents t1 = findTangents(r, P1);
  const Tangents t2 = findTangents(r, P2);
  const bool counter_clockwise = chooseCounterClockwise(cylinder, t1, t2);
  const Vector2d r1 = counter_clockwise ? t1.a : t1.b;
  const Vector2d r2 = counter_clockwise ? t2.b : t2.a;

  const double theta = std::atan2(r1.x() * r2.y() - r1.y() * r2.x(), r1.dot(r2));
  contact.turn = theta;
  if (isLongWrap(cylinder, r1, r2, P1, P2)) {
    contact.turn = theta > 0 ? theta - 2 * kPi : theta + 2 * kPi;
  }

  // Unrolled, the path is one straight line over tangent, arc and tangent.
  const double arc = r * std::abs(contact.turn);
  const double s1 = (r1 - P1.head<2>()).norm();
  const double s2 = (r2 - P2.head<2>()).norm();
  const double slope = (P2.z() - P1.z()) / (s1 + arc + s2);
  contact.r1 << r1, P1.z() + slope * s1;
  contact.r2 << r2, P1.z() + slope * (s1 + arc);
  contact.surface_length = arc * std::sqrt(1 + slope * slope);

  const double half = 0.5 * cylinder.length;
  if (std::abs(contact.r1.z()) > half && std::abs(contact.r2.z()) > half) {
    contact.status = WrapContact::Status::kNone;
  }
  return contact;
}

}  // namespace gaitmill

#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/model/model.h"
#include "core/model/wrap_cylinder.h"

namespace gaitmill {

/// Length and moment arms of a path over ONE cylinder as OpenSim 4.6 approximates them
/// (spec/path.md 5.5: tangent points slid into a plane instead of the geodesic). Only tests use it:
/// it shows that where our exact path differs from the reference numbers, this approximation is the
/// whole difference.
class NearGeodesic {
 public:
  NearGeodesic(const ModelState& state, const MuscleSpec& muscle) : state_(state) {
    const Model& model = state.model();
    for (const PathPointSpec& point : muscle.path) {
      const BodyIndex body = model.getBody(point.body);
      nodes_.push_back({body, state.pose(body) * point.location});
    }
    for (std::size_t b = 0; !muscle.wraps.empty() && b < model.spec().bodies.size(); ++b) {
      for (const WrapObjectSpec& wrap : model.spec().bodies[b].wrap_objects) {
        if (wrap.name == muscle.wraps[0].wrap_object) {
          addWrap(wrap, BodyIndex(static_cast<int>(b)), muscle.wraps[0]);
        }
      }
    }
  }

  double calcLength() const {
    double length = 0;
    for (std::size_t i = 0; i + 1 < nodes_.size(); ++i) {
      const bool surface = static_cast<int>(i) == surface_segment_;
      length += surface ? surface_length_ : (nodes_[i + 1].p - nodes_[i].p).norm();
    }
    return length;
  }

  double calcMomentArm(CoordinateIndex c) const { return calcMomentArms()[c.value()]; }

  double calcSpeed(const Eigen::VectorXd& u) const { return -calcMomentArms().dot(u); }

 private:
  struct Node {
    BodyIndex body;
    Eigen::Vector3d p;
  };

  Eigen::VectorXd calcMomentArms() const {
    Eigen::VectorXd tau = Eigen::VectorXd::Zero(state_.model().coordinateCount());
    for (std::size_t i = 0; i + 1 < nodes_.size(); ++i) {
      if (nodes_[i].body == nodes_[i + 1].body) {
        continue;
      }
      const Eigen::Vector3d e = (nodes_[i + 1].p - nodes_[i].p).normalized();
      Vector6 pull;
      pull << nodes_[i].p.cross(e), e;
      state_.addWrench({nodes_[i].body, pull}, tau);
      state_.addWrench({nodes_[i + 1].body, -pull}, tau);
    }
    return tau;
  }

  void addWrap(const WrapObjectSpec& spec, BodyIndex body, const PathWrapSpec& range) {
    const WrapCylinder cylinder = makeWrapCylinder(spec);
    Pose X;
    X.R = state_.pose(body).R * (Eigen::AngleAxisd(spec.rotation.x(), Eigen::Vector3d::UnitX()) *
                                 Eigen::AngleAxisd(spec.rotation.y(), Eigen::Vector3d::UnitY()) *
                                 Eigen::AngleAxisd(spec.rotation.z(), Eigen::Vector3d::UnitZ()))
                                    .toRotationMatrix();
    X.p = state_.pose(body) * spec.translation;
    const std::size_t first =
        range.first_point < 1 ? 0 : static_cast<std::size_t>(range.first_point - 1);
    const std::size_t last =
        range.last_point < 1 ? nodes_.size() - 1 : static_cast<std::size_t>(range.last_point - 1);
    double least_detour = 1e300;
    for (std::size_t i = first; i < last; ++i) {
      const Eigen::Vector3d P1 = X.R.transpose() * (nodes_[i].p - X.p);
      const Eigen::Vector3d P2 = X.R.transpose() * (nodes_[i + 1].p - X.p);
      WrapContact contact = calcWrapContact(cylinder, P1, P2);
      if (!contact.wraps()) {
        continue;
      }
      slideIntoPlane(cylinder, P1, P2, contact);
      const double detour = (contact.r1 - P1).norm() + contact.surface_length +
                            (contact.r2 - P2).norm() - (P2 - P1).norm();
      if (contact.status == WrapContact::Status::kMandatory || detour < least_detour) {
        least_detour = detour;
        surface_segment_ = static_cast<int>(i) + 1;
        surface_length_ = contact.surface_length;
        tangent_1_ = {body, X * contact.r1};
        tangent_2_ = {body, X * contact.r2};
      }
      if (contact.status == WrapContact::Status::kMandatory) {
        break;
      }
    }
    if (surface_segment_ > 0) {
      nodes_.insert(nodes_.begin() + surface_segment_, {tangent_1_, tangent_2_});
    }
  }

  /// Whether the constrained path takes the side of the cylinder that is farther from the straight
  /// line.
  static bool isFar(const WrapCylinder& cylinder,
                    const Eigen::Vector3d& P1,
                    const Eigen::Vector3d& P2,
                    bool ccw) {
    if (cylinder.axis < 0) {
      return false;
    }
    const auto tangent = [&](const Eigen::Vector3d& P, double side) {
      const double angle =
          std::atan2(P.y(), P.x()) + side * std::acos(cylinder.radius / P.head<2>().norm());
      return Eigen::Vector2d(cylinder.radius * std::cos(angle), cylinder.radius * std::sin(angle));
    };
    const Eigen::Vector2d a1 = tangent(P1, 1), b1 = tangent(P1, -1), a2 = tangent(P2, 1),
                          b2 = tangent(P2, -1);
    const auto off = [&](const Eigen::Vector2d& r) {
      return (r[cylinder.axis] >= 0 ? 1.0 : -1.0) != cylinder.sign;
    };
    if (off(a1) && off(b1) && off(a2) && off(b2)) {
      return true;
    }
    const bool alpha_larger = a1.dot(b2) < b1.dot(a2);
    return ccw ? alpha_larger : !alpha_larger;
  }

  static void slideIntoPlane(const WrapCylinder& cylinder,
                             const Eigen::Vector3d& P1,
                             const Eigen::Vector3d& P2,
                             WrapContact& contact) {
    const double rho1 = P1.head<2>().norm();
    const double rho2 = P2.head<2>().norm();
    const Eigen::Vector3d m = P1 + rho1 / (rho1 + rho2) * (P2 - P1);
    const Eigen::Vector3d C(0, 0, m.z());
    const Eigen::Vector3d n = (P1 - C).normalized().cross((P2 - C).normalized()).normalized();
    const Eigen::Vector3d side = cylinder.radius * Eigen::Vector3d::UnitZ().cross(n).normalized();
    const double plus = (C + side - m).norm();
    const double minus = (C - side - m).norm();
    const bool far = isFar(cylinder, P1, P2, contact.turn > 0);
    const bool take_plus = far ? plus >= minus : plus < minus;
    const Eigen::Vector3d A = take_plus ? Eigen::Vector3d(C + side) : Eigen::Vector3d(C - side);
    const Eigen::Vector3d q = (P1 - A).normalized().cross((P2 - A).normalized()).normalized();
    const auto slide = [&](const Eigen::Vector3d& r, double own_z, double other_z) {
      if (std::abs(20 * q.z()) < 1e-5) {
        return own_z;
      }
      const double z = A.z() - (q.x() * (r.x() - A.x()) + q.y() * (r.y() - A.y())) / q.z();
      const bool accepted =
          std::abs(z - own_z) <= 10 && std::abs(z - other_z) < std::abs(own_z - other_z);
      return accepted ? z : own_z;
    };
    contact.r1.z() = slide(contact.r1, P1.z(), P2.z());
    contact.r2.z() = slide(contact.r2, P2.z(), P1.z());
    contact.surface_length =
        std::hypot(cylinder.radius * contact.turn, contact.r2.z() - contact.r1.z());
  }

  const ModelState& state_;
  std::vector<Node> nodes_;
  int surface_segment_ = -1;
  double surface_length_ = 0;
  Node tangent_1_, tangent_2_;
};

}  // namespace gaitmill

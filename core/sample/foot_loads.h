#pragma once

#include <memory>

#include <Eigen/Core>

#include "core/sample/gait_pattern.h"

namespace gaitmill {

/// What the ground must do to the whole body for a motion to happen: force, the point of the floor
/// (y = 0) about which its moment has no horizontal part, and the vertical moment about that point.
struct NetReaction {
  Eigen::Vector3d force;        ///< [N]
  Eigen::Vector3d point;        ///< [m] the zero moment point
  double vertical_moment;       ///< [N.m]
  Eigen::Vector3d mass_center;  ///< [m] of the whole body
};

/// Ground reaction under one foot; all zero while it is off the ground.
struct FootLoad {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< [N] on the foot
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   ///< [m] centre of pressure, y = 0
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< [N.m] free torque, vertical
};

struct FootLoads {
  FootLoad right;
  FootLoad left;
};

/// Distributes the Newton-Euler wrench of a walking motion over the feet so that nothing is left
/// for the pelvis. In single support the stance foot bears all of it, its centre of pressure being
/// the zero moment point Z. In double support the leading foot takes the share s, a quintic step
/// from 0 to 1 in time, at centres of pressure with (1 - s) p_trail + s p_lead = Z:
///   F_lead = s F + h e,  F_trail = (1 - s) F - h e,   e from p_lead to p_trail
/// The pair of forces h e along the line between the centres changes no net force or moment; it
/// points both legs' forces towards the body, as braking and push-off do. Everything is twice
/// continuously differentiable in time. One per thread: calc works on memory of its own.
class FootLoadDistribution {
 public:
  /// Share of the cycle that each double support lasts: stance 70 % of the cycle, as the published
  /// trial above 5 N.
  static constexpr double kDoubleSupport = 0.20;

  /// Keeps a reference to the motion and its model. @throws Error kModelReference if the model
  /// lacks the feet ("calcn_r") or their markers ("RCAL", "RTOE") that say how long they are
  explicit FootLoadDistribution(const GaitMotion& motion);
  ~FootLoadDistribution();
  FootLoadDistribution(const FootLoadDistribution&) = delete;
  FootLoadDistribution& operator=(const FootLoadDistribution&) = delete;

  NetReaction calcNet(double t);
  FootLoads calc(double t);

  /// Where the net reaction should act [m]: centres of pressure that roll from heel to toe as in
  /// the published trial while each foot is on the ground, weighted by the feet's shares.
  Eigen::Vector3d calcTarget(double t);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gaitmill

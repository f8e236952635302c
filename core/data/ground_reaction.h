#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace gaitmill {

enum class Foot { kUnknown, kRight, kLeft };

/// One force that acts on one body over time: force on the subject, its point of application and
/// the free torque, all in ground [N, m, N.m]. Where the plate is unloaded, force and torque are
/// exactly zero and the point is meaningless (whatever the file said).
struct ExternalForce {
  std::string name;         ///< column family in the file: "ground_force_r", "1_ground_force"
  std::string body;         ///< body it acts on: "calcn_r"
  Eigen::Matrix3Xd force;   ///< (3 x n)
  Eigen::Matrix3Xd point;   ///< (3 x n) centre of pressure
  Eigen::Matrix3Xd torque;  ///< (3 x n) about the point
};

/// Ground reactions of a trial, all forces on one time axis.
struct GroundReaction {
  std::vector<double> time;  ///< [s] non-decreasing
  std::vector<ExternalForce> forces;
};

}  // namespace gaitmill

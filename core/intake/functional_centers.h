#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/data/marker_trajectories.h"
#include "core/intake/marker_names.h"

namespace gaitmill {

// Joint centres from movements made to show them.

/// Joint whose centre a movement shows.
enum class FunctionalJoint { kRightHip, kLeftHip, kRightKnee, kLeftKnee };

/// The recording of one such movement.
struct FunctionalTrial {
  FunctionalJoint joint = FunctionalJoint::kRightHip;
  std::string name;  ///< of the file, for messages
  MarkerTrajectories markers;
};

/// Rotation R and translation t of a cluster of markers: x = R y + t.
struct ClusterPose {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
};

/// Least-squares rigid motion from one cloud of points to another (Kabsch 1976, Acta Cryst
/// A32:922).
/// @param from, to  (3 x n), columns that are not finite in either are left out
/// @returns nothing with fewer than three points or points in a line
std::optional<ClusterPose> fitRigidMotion(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to);

/// What a movement says of its joint.
struct JointEstimate {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< where both segments stand at pose 0 [m]
  /// RMS distance between the centre seen from one segment and from the other [m].
  double residual = -1;
  /// Unit vector of a hinge at pose 0; zero for a ball joint.
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
};

/// Symmetrical centre of rotation estimate (Ehrig et al. 2006, J Biomech 39:2798): the point c_p of
/// the proximal and c_d of the distal segment that minimize
///   sum_i |R_pi c_p + t_pi - R_di c_d - t_di|^2
/// For a hinge the direction that the movement leaves open is its axis (Ehrig et al. 2007, J
/// Biomech 40:2150), and the centre is the point of the axis nearest to `near`.
/// @param proximal, distal  poses against pose 0, one per frame
/// @returns nothing if the movement turns the joint by too little (RMS less than about 8 deg about
///   two axes, of a hinge about one)
std::optional<JointEstimate> estimateJoint(const std::vector<ClusterPose>& proximal,
                                           const std::vector<ClusterPose>& distal,
                                           const Eigen::Vector3d& near,
                                           bool is_hinge);

/// Adds the joint centres that movements show to a static trial: RHJC, LHJC (seen from the pelvis),
/// RKJC, LKJC (the mean of both sides of the knee). Where the static trial has a marker of that
/// landmark, the functional centre replaces it.
/// @param mapping  of the markers of all these trials
/// @returns sentences about what was found and what could not be used
std::vector<std::string> addFunctionalCenters(const std::vector<FunctionalTrial>& trials,
                                              const MarkerMapping& mapping,
                                              MarkerTrajectories& static_pose);

}  // namespace gaitmill

#include "core/intake/functional_centers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "core/base/text.h"
#include "core/intake/landmarks.h"

namespace gaitmill {

namespace {

using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A direction of the centre shows as 1 - cos of how far the joint turns across it, on average;
/// 0.01 is 8 deg RMS. With 2 mm of marker noise and 500 frames the centre is then good to 1 mm.
constexpr double kMinTurn = 0.01;
/// Beyond this distance between both segments' views the clusters slip on the skin [m] (Ehrig et
/// al. 2006 simulate up to 20 mm of it).
constexpr double kMaxResidual = 0.015;
constexpr int kMinFrames = 50;

/// Names and segments of a joint.
struct JointRow {
  FunctionalJoint joint;
  const char* words;
  const char* landmark;
  const char* proximal;  ///< body of Rajagopal2016
  const char* distal;
  bool is_hinge;
};

constexpr JointRow kJoints[] = {
    {FunctionalJoint::kRightHip, "right hip", "RHJC", "pelvis", "femur_r", false},
    {FunctionalJoint::kLeftHip, "left hip", "LHJC", "pelvis", "femur_l", false},
    {FunctionalJoint::kRightKnee, "right knee", "RKJC", "femur_r", "tibia_r", true},
    {FunctionalJoint::kLeftKnee, "left knee", "LKJC", "femur_l", "tibia_l", true},
};

const JointRow& findRow(FunctionalJoint joint) {
  return *std::find_if(std::begin(kJoints), std::end(kJoints), [&](const JointRow& row) {
    return row.joint == joint;
  });
}

/// The markers of one segment that two trials share: columns of both.
struct Cluster {
  std::vector<int> in_static;
  std::vector<int> in_movement;
};

Cluster findCluster(const std::string& body,
                    const MarkerMapping& mapping,
                    const MarkerTrajectories& static_pose,
                    const MarkerTrajectories& movement) {
  Cluster cluster;
  for (const MarkerName& name : mapping.names) {
    const Landmark* mark = name.landmark.empty() ? nullptr : findLandmark(name.landmark);
    // A computed point moves with whatever it was computed from.
    const bool usable =
        mark != nullptr && mark->body == body &&
        (mark->kind == LandmarkKind::kBony || mark->kind == LandmarkKind::kTechnical);
    const std::optional<int> a = static_pose.findMarker(name.measured);
    const std::optional<int> b = movement.findMarker(name.measured);
    if (usable && a && b) {
      cluster.in_static.push_back(*a);
      cluster.in_movement.push_back(*b);
    }
  }
  return cluster;
}

Matrix3Xd collect(const MarkerTrajectories& trial, int frame, const std::vector<int>& columns) {
  Matrix3Xd points(3, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    points.col(static_cast<Eigen::Index>(i)) = trial.position(frame, columns[i]);
  }
  return points;
}

/// Mean positions over the frames where a marker is seen; NaN where it never is.
Matrix3Xd collectMean(const MarkerTrajectories& trial, const std::vector<int>& columns) {
  Matrix3Xd mean = Matrix3Xd::Constant(3, static_cast<Eigen::Index>(columns.size()), kNaN);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    Vector3d sum = Vector3d::Zero();
    int seen = 0;
    for (int frame = 0; frame < trial.frameCount(); ++frame) {
      if (!trial.isMissing(frame, columns[i])) {
        sum += trial.position(frame, columns[i]);
        ++seen;
      }
    }
    if (seen > 0) {
      mean.col(static_cast<Eigen::Index>(i)) = sum / seen;
    }
  }
  return mean;
}

/// Sums of the normal equations: ((R_p'R_p, -R_p'R_d), (-R_d'R_p, R_d'R_d)).
struct NormalEquations {
  Matrix6d matrix = Matrix6d::Zero();
  Vector6d right = Vector6d::Zero();
};

NormalEquations sumUp(const std::vector<ClusterPose>& proximal,
                      const std::vector<ClusterPose>& distal,
                      const Vector3d& near) {
  NormalEquations sums;
  const double weight = 1.0 / static_cast<double>(proximal.size());
  for (std::size_t i = 0; i < proximal.size(); ++i) {
    Eigen::Matrix<double, 3, 6> A;
    A << proximal[i].R, -distal[i].R;
    const Vector3d gap =
        (distal[i].R * near + distal[i].t) - (proximal[i].R * near + proximal[i].t);
    sums.matrix += weight * A.transpose() * A;
    sums.right += weight * A.transpose() * gap;
  }
  return sums;
}

double calcResidual(const std::vector<ClusterPose>& proximal,
                    const std::vector<ClusterPose>& distal,
                    const Vector3d& c_p,
                    const Vector3d& c_d) {
  double sum = 0;
  for (std::size_t i = 0; i < proximal.size(); ++i) {
    sum += (proximal[i].R * c_p + proximal[i].t - distal[i].R * c_d - distal[i].t).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(proximal.size()));
}

/// Poses of both clusters in the frames that show both.
void collectPoses(const FunctionalTrial& trial,
                  const MarkerTrajectories& static_pose,
                  const Cluster& proximal,
                  const Cluster& distal,
                  std::vector<ClusterPose>& proximal_poses,
                  std::vector<ClusterPose>& distal_poses) {
  const Matrix3Xd proximal_shape = collectMean(static_pose, proximal.in_static);
  const Matrix3Xd distal_shape = collectMean(static_pose, distal.in_static);
  for (int frame = 0; frame < trial.markers.frameCount(); ++frame) {
    const auto p =
        fitRigidMotion(proximal_shape, collect(trial.markers, frame, proximal.in_movement));
    const auto d = fitRigidMotion(distal_shape, collect(trial.markers, frame, distal.in_movement));
    if (p && d) {
      proximal_poses.push_back(*p);
      distal_poses.push_back(*d);
    }
  }
}

/// Writes a point fixed in the proximal cluster into every frame of the static trial.
void store(const Vector3d& center,
           const std::string& name,
           const Cluster& proximal,
           MarkerTrajectories& static_pose) {
  std::optional<int> column = static_pose.findMarker(name);
  if (!column) {
    column = static_pose.markerCount();
    static_pose.names.push_back(name);
    static_pose.positions.conservativeResize(Eigen::NoChange, static_pose.positions.cols() + 3);
  }
  const Matrix3Xd shape = collectMean(static_pose, proximal.in_static);
  for (int frame = 0; frame < static_pose.frameCount(); ++frame) {
    const auto pose = fitRigidMotion(shape, collect(static_pose, frame, proximal.in_static));
    const Vector3d point = pose ? Vector3d(pose->R * center + pose->t) : Vector3d::Constant(kNaN);
    static_pose.positions.row(frame).segment<3>(Eigen::Index{3} * *column) = point.transpose();
  }
}

/// A point near the joint to begin with: the middle of what is measured around it.
Vector3d findNear(const JointRow& row,
                  const MarkerMapping& mapping,
                  const MarkerTrajectories& static_pose,
                  const Matrix3Xd& proximal_shape) {
  const std::string side(1, row.landmark[0]);
  std::vector<int> columns;
  for (const char* place : {"LFC", "MFC"}) {
    const std::string* measured = mapping.findMeasured(side + place);
    const std::optional<int> column = measured ? static_pose.findMarker(*measured) : std::nullopt;
    if (row.is_hinge && column) {
      columns.push_back(*column);
    }
  }
  const Matrix3Xd points = columns.empty() ? proximal_shape : collectMean(static_pose, columns);
  return points.rowwise().mean();
}

std::string addCenter(const FunctionalTrial& trial,
                      const MarkerMapping& mapping,
                      MarkerTrajectories& static_pose) {
  const JointRow& row = findRow(trial.joint);
  const std::string about = trial.name + ": the centre of the " + row.words;
  const Cluster proximal = findCluster(row.proximal, mapping, static_pose, trial.markers);
  const Cluster distal = findCluster(row.distal, mapping, static_pose, trial.markers);
  std::vector<ClusterPose> proximal_poses, distal_poses;
  collectPoses(trial, static_pose, proximal, distal, proximal_poses, distal_poses);
  if (static_cast<int>(proximal_poses.size()) < kMinFrames) {
    return about + " cannot be found: only " + std::to_string(proximal_poses.size()) +
           " frames show three markers of the static trial on " + row.proximal + " and on " +
           row.distal;
  }
  const Vector3d near =
      findNear(row, mapping, static_pose, collectMean(static_pose, proximal.in_static));
  const auto joint = estimateJoint(proximal_poses, distal_poses, near, row.is_hinge);
  if (!joint) {
    return about + " cannot be found: the joint turns too little";
  }
  if (joint->residual > kMaxResidual) {
    return about + " is not used: seen from both segments it differs by " +
           formatFixed(1000 * joint->residual, 1) + " mm RMS, the markers slip";
  }
  const std::string* known = mapping.findMeasured(row.landmark);
  const std::string name = known != nullptr ? *known : row.landmark;
  store(joint->center, name, proximal, static_pose);
  return about + " is '" + name + "', residual " + formatFixed(1000 * joint->residual, 1) +
         " mm RMS over " + std::to_string(proximal_poses.size()) + " frames";
}

}  // namespace

std::optional<ClusterPose> fitRigidMotion(const Matrix3Xd& from, const Matrix3Xd& to) {
  Vector3d from_mean = Vector3d::Zero(), to_mean = Vector3d::Zero();
  int count = 0;
  const auto counts = [&](Eigen::Index i) {
    return from.col(i).allFinite() && to.col(i).allFinite();
  };
  for (Eigen::Index i = 0; i < from.cols(); ++i) {
    if (counts(i)) {
      from_mean += from.col(i);
      to_mean += to.col(i);
      ++count;
    }
  }
  if (count < 3) {
    return std::nullopt;
  }
  from_mean /= count;
  to_mean /= count;
  Matrix3d covariance = Matrix3d::Zero();
  for (Eigen::Index i = 0; i < from.cols(); ++i) {
    if (counts(i)) {
      covariance += (to.col(i) - to_mean) * (from.col(i) - from_mean).transpose();
    }
  }
  const Eigen::JacobiSVD<Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (!(svd.singularValues()[1] > 1e-6 * svd.singularValues()[0])) {
    return std::nullopt;
  }
  Vector3d signs = Vector3d::Ones();
  signs.z() = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  ClusterPose pose;
  pose.R = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  pose.t = to_mean - pose.R * from_mean;
  return pose;
}

std::optional<JointEstimate> estimateJoint(const std::vector<ClusterPose>& proximal,
                                           const std::vector<ClusterPose>& distal,
                                           const Vector3d& near,
                                           bool is_hinge) {
  if (proximal.empty() || proximal.size() != distal.size()) {
    return std::nullopt;
  }
  const NormalEquations sums = sumUp(proximal, distal, near);
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(sums.matrix);
  // Ascending; of a hinge the first is its axis, which stays where `near` is.
  const Eigen::Index first = is_hinge ? 1 : 0;
  if (!(solver.eigenvalues()[first] > kMinTurn)) {
    return std::nullopt;
  }
  Vector6d offset = Vector6d::Zero();
  for (Eigen::Index k = first; k < 6; ++k) {
    const Vector6d direction = solver.eigenvectors().col(k);
    offset += direction * (direction.dot(sums.right) / solver.eigenvalues()[k]);
  }
  const Vector3d c_p = near + offset.head<3>();
  const Vector3d c_d = near + offset.tail<3>();
  JointEstimate joint;
  joint.residual = calcResidual(proximal, distal, c_p, c_d);
  joint.center = is_hinge ? Vector3d(0.5 * (c_p + c_d)) : c_p;
  if (is_hinge) {
    joint.axis = solver.eigenvectors().col(0).head<3>().normalized();
  }
  return joint;
}

std::vector<std::string> addFunctionalCenters(const std::vector<FunctionalTrial>& trials,
                                              const MarkerMapping& mapping,
                                              MarkerTrajectories& static_pose) {
  std::vector<std::string> sentences;
  for (const FunctionalTrial& trial : trials) {
    sentences.push_back(addCenter(trial, mapping, static_pose));
  }
  return sentences;
}

}  // namespace gaitmill

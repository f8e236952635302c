#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/data/gait.h"
#include "core/data/marker_trajectories.h"

namespace gaitmill {

/// Markers that show where one foot is, as positions in MarkerTrajectories::names, the most telling
/// first. Heel and toe may hold the same marker where a foot has only one.
struct FootMarkers {
  std::vector<int> heel;
  std::vector<int> toe;
};

/// All that contacts and events look at, from whichever source knows the names.
struct GaitMarkers {
  FootMarkers right;
  FootMarkers left;
  std::vector<int> pelvis;
};

/// The foot that a marker sits on, by the field's usual names: heel, calcaneus, toe, metatarsal,
/// ankle or malleolus with the side in front or behind ("RHEE", "R.Heel", "LMT5", "toe_l"). Unknown
/// for all others.
Foot findFootOfMarker(const std::string& marker);

/// By the field's usual names; lists stay empty where no name is known.
GaitMarkers findGaitMarkers(const std::vector<std::string>& names);

/// Where a foot is in each frame; NaN where it is not seen.
struct FootMotion {
  Eigen::Matrix3Xd heel;  ///< (3 x frames) [m] ground
  Eigen::Matrix3Xd toe;   ///< (3 x frames) [m] ground

  /// Horizontal distance of a point in ground to the line from heel to toe [m]; NaN if unseen.
  double calcDistance(const Eigen::Vector3d& point, int frame) const;
};

/// Both feet and the pelvis over the frames of a recording.
struct GaitMotion {
  std::vector<double> time;  ///< [s]
  FootMotion right;
  FootMotion left;
  Eigen::Matrix3Xd pelvis;  ///< (3 x frames) [m] centre of its markers, else of all markers
  /// Where the toes point, on average over both feet; horizontal unit vector. It tells the walking
  /// direction on a treadmill as well.
  Eigen::Vector3d forward = Eigen::Vector3d::UnitX();

  const FootMotion& foot(Foot side) const { return side == Foot::kLeft ? left : right; }
  /// The frame nearest to a time that the record covers, or -1.
  int findFrame(double t) const;
};

/// Gaps of at most 0.1 s are bridged by straight lines: contacts and events need no more.
GaitMotion makeGaitMotion(const MarkerTrajectories& markers, const GaitMarkers& chosen);

}  // namespace gaitmill

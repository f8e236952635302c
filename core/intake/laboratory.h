#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/data/decision.h"
#include "core/data/marker_trajectories.h"

namespace gaitmill {

/// A coordinate axis of a laboratory, with its direction: "x", "-z".
struct SignedAxis {
  int axis = 0;  ///< 0 x, 1 y, 2 z
  int sign = 1;  ///< 1 or -1

  Eigen::Vector3d direction() const { return sign * Eigen::Vector3d::Unit(axis); }
  std::string name() const;
  bool operator==(const SignedAxis& other) const {
    return axis == other.axis && sign == other.sign;
  }
};

/// What the settings say of a laboratory; nothing = it is read out of the data.
struct LaboratoryOptions {
  std::optional<SignedAxis> vertical;  ///< that points up
  std::optional<SignedAxis> forward;   ///< that the subject moves, or faces on a treadmill, along
  std::optional<double> metres_per_unit;  ///< of the marker files, instead of what they state
};

/// Markers by what they are known to sit on; positions in MarkerTrajectories::names.
struct BodyMarkers {
  std::vector<int> right_foot;
  std::vector<int> left_foot;
  std::vector<int> others;
};

/// How ground lies in a laboratory: p_ground = R p_laboratory. Ground has X forward, Y up, Z to the
/// right.
struct LaboratoryFrame {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  SignedAxis vertical{1, 1};
};

/// Rows forward, up, right: turns vectors of a laboratory into ground.
Eigen::Matrix3d makeTurn(const Eigen::Vector3d& forward, const Eigen::Vector3d& up);

/// Finds the axis that points up: from the feet to the rest of the body. Without known feet
/// `usual`. @throws Error kInputAmbiguous naming both readings
SignedAxis decideVertical(const MarkerTrajectories& markers,
                          const BodyMarkers& body,
                          const LaboratoryOptions& options,
                          SignedAxis usual,
                          Decisions& decisions);

/// The frame of a movement. Forward is the way the body travels; on a treadmill, the way in which
/// the feet move against the body while they are high (swing) rather than low (stance). Within 20
/// degrees of an axis it is that axis, so that a laboratory that is aligned stays exactly so.
/// @throws Error kInputAmbiguous if both ways tell different directions
LaboratoryFrame decideFrame(const MarkerTrajectories& markers,
                            const BodyMarkers& body,
                            const LaboratoryOptions& options,
                            SignedAxis usual_vertical,
                            Decisions& decisions);

/// Metres that one unit of the positions is: 1 where they are what the file states, else the
/// correction, from the extent of the body (0.35 to 2.6 m). @param stated  "mm", "m", "cm"
/// @throws Error kInputAmbiguous if no unit gives a human
double decideMarkerUnit(const MarkerTrajectories& markers,
                        const std::string& stated,
                        const LaboratoryOptions& options,
                        Decisions& decisions);

/// Turns positions into ground. The identity changes no bit.
void applyFrame(const LaboratoryFrame& frame, MarkerTrajectories& markers);

}  // namespace gaitmill

#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/data/marker_set.h"
#include "core/data/marker_trajectories.h"

namespace gaitmill {

/// What a pelvis shows of itself; any length unit.
struct PelvisPoints {
  Eigen::Vector3d right_asis;
  Eigen::Vector3d left_asis;
  Eigen::Vector3d mid_psis;
};

/// Hip centre by the regression of Harrington et al. (2007), J Biomech 40:595 (spec/scale.md 7.3):
/// from mid ASIS, x forward, y up, z right, with the width PW between the ASIS and the depth PD
/// from mid ASIS to mid PSIS, in metres
///   x = -0.24 PD - 0.0099,  y = -0.30 PW - 0.0109,  z = +-(0.33 PW + 0.0073)
/// Its typical error is 1 to 2 cm. @param right  which side; @returns [m], nothing if the points
/// lie in a line
std::optional<Eigen::Vector3d> calcHipCenter(const PelvisPoints& pelvis, bool right);

/// Adds the points that can be computed to a recording. One whose sources the recording does not
/// have is left out, and so is one that it has already: what was measured counts.
void addVirtualMarkers(const std::vector<VirtualMarkerSpec>& points, MarkerTrajectories& trial);

}  // namespace gaitmill

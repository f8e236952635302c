#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/data/marker_set.h"
#include "core/data/marker_trajectories.h"

namespace gaitmill {

/// Frames that stand for a motion: the range is cut into `count` equal parts, and of each the frame
/// is taken that shows most of the markers, the one closest to the middle among equals. A part
/// whose best frame shows less than half of what the best of all shows is left out.
/// @returns frame numbers in time order
/// @throws Error kInputTimeRange if the range holds no frame, kInputMarkers if no marker is visible
std::vector<int> chooseFrames(const MarkerTrajectories& trial,
                              const std::vector<std::string>& markers,
                              const TimeRange& range,
                              int count);

/// Markers of one frame, (3 x markers.size()) [m], NaN = missing.
Eigen::Matrix3Xd readMarkers(const MarkerTrajectories& trial,
                             const std::vector<std::string>& markers,
                             int frame);

}  // namespace gaitmill

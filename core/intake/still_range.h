#pragma once

#include <string>
#include <vector>

#include "core/data/marker_set.h"
#include "core/data/marker_trajectories.h"

namespace gaitmill {

/// The part of a static trial that is used.
struct StillRange {
  TimeRange range;   ///< frames to average
  double sway = -1;  ///< [m] within it: RMS distance of a marker from its mean, median over markers
  double whole_sway = -1;             ///< [m] over the whole recording
  int frames = 0;                     ///< in the range
  std::vector<std::string> warnings;  ///< that it moves, is short, has gaps
};

/// Where a subject stands still: the whole recording if its markers sway by less than 5 mm, else
/// the quietest half second (or the whole of what is shorter). Of equal ones the earliest.
/// @throws Error kInputMarkers if no marker is seen
StillRange findStillRange(const MarkerTrajectories& trial);

}  // namespace gaitmill

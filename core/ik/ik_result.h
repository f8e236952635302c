#pragma once

#include <string>
#include <vector>

#include "core/data/time_series.h"

namespace gaitmill {

/// Coordinates of a trial and how well the markers are met. Row i of every member is the same
/// frame.
struct IkResult {
  TimeSeries coordinates;  ///< all model coordinates in model order [rad|m]

  /// total_squared_error [m^2], marker_error_RMS, marker_error_max [m], unweighted, over the
  /// markers visible in the frame; weighted_squared_error is the objective that was minimized.
  TimeSeries errors;
  TimeSeries marker_errors;                ///< distance per marker [m], NaN where it is missing
  std::vector<std::string> worst_markers;  ///< of each frame
  std::vector<int> visible_counts;
  std::vector<int> iterations;

  // What was used.
  std::vector<std::string> markers;
  std::vector<double> weights;
  std::vector<std::string> unused_tasks;      ///< weighted, but not measured or not in the model
  std::vector<std::string> held_coordinates;  ///< nothing observes them: held at their default
  /// Smallest eigenvalue of the first frame's normalized normal matrix [m^2/rad^2]; sqrt of it is
  /// how far the worst observed direction moves the markers per radian.
  double observability = -1;

  // Summary.
  int unconverged_frames = 0;
  double mean_rms = -1;          ///< [m]
  double max_rms = -1;           ///< [m], in frame worst_frame
  double max_error = -1;         ///< [m], of marker max_error_marker
  double worst_frame_time = -1;  ///< [s]
  std::string max_error_marker;
  std::vector<std::string> warnings;
};

}  // namespace gaitmill

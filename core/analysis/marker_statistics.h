#pragma once

#include <string>
#include <vector>

#include "core/data/time_series.h"

namespace gaitmill {

/// How well one marker of the model meets its measurement over a trial. Figures are NaN if the
/// marker was seen in no frame.
struct MarkerStatistics {
  std::string marker;
  double weight = 0;            ///< in the fit
  double mean;                  ///< [m]
  double rms;                   ///< [m]
  double max;                   ///< [m]
  int max_frame = -1;           ///< row of the largest error, from 0
  double max_time;              ///< [s] of that row
  double visible_fraction = 0;  ///< of the frames
};

/// @param distances  one column per marker [m], NaN where it is missing
/// @param weights    one per column
/// @throws Error kTableNoRows
std::vector<MarkerStatistics> calcMarkerStatistics(const TimeSeries& distances,
                                                   const std::vector<double>& weights);

}  // namespace gaitmill

#pragma once

#include <string>
#include <vector>

#include "core/data/time_series.h"

namespace gaitmill {

/// Size of one actuator's force over time.
struct ActuatorStatistics {
  std::string name;
  double peak = 0;  ///< max |f| [N|N.m]
  double rms = 0;   ///< [N|N.m]
};

/// Peak and RMS of the named columns, in the given order: the residual actuators at the pelvis
/// ("FX"
/// ... "MZ"), or the reserves at the joints. @throws Error kTableUnknownLabel, kTableNoRows
std::vector<ActuatorStatistics> calcActuatorStatistics(const TimeSeries& forces,
                                                       const std::vector<std::string>& names);

/// The entry with the largest peak. @throws Error kTableNoRows if there is none
const ActuatorStatistics& findLargestPeak(const std::vector<ActuatorStatistics>& statistics);

}  // namespace gaitmill

#pragma once

#include <vector>

#include "core/data/model_spec.h"
#include "core/data/time_series.h"
#include "core/model/external_loads.h"

namespace gaitmill {

/// A motion and every force that made it. All tables share their rows; columns are found by name,
/// others are ignored.
struct ForceRecord {
  const TimeSeries& pose;             ///< all coordinates of the model [rad|m]
  const TimeSeries& speed;            ///< [rad/s|m/s]
  const TimeSeries& muscle_forces;    ///< tensions [N]
  const TimeSeries& actuator_forces;  ///< [N|N.m]
  std::vector<ActuatorSpec> actuators;
  const ExternalLoads& loads;
};

}  // namespace gaitmill

#pragma once

#include <string>
#include <vector>

#include "core/data/time_series.h"

namespace gaitmill {

/// A row that the actuators could not produce entirely.
struct InfeasibleRow {
  double time = 0;         ///< [s]
  std::string coordinate;  ///< the one that misses most
  double missing = 0;      ///< demanded minus produced generalized force [N|N.m]
};

/// Forces that explain a motion, each row on its own.
struct SoResult {
  /// Activations of the muscles, then controls of the actuators [-].
  TimeSeries activations;
  /// Force along the tendon of each muscle (its passive part included where asked for), then forces
  /// and torques of the actuators [N|N.m].
  TimeSeries forces;
  /// Generalized force demanded by inverse dynamics at the free coordinates [N|N.m].
  TimeSeries demand;
  /// Motion that the forces explain, as splined: all coordinates of the model.
  TimeSeries pose;       ///< q [rad|m]
  TimeSeries speed;      ///< u
  int muscle_count = 0;  ///< leading columns that are muscles

  std::vector<InfeasibleRow> infeasible_rows;
  std::vector<int> iterations;  ///< Newton steps of each row
  /// Largest |force| of each actuator over the rows, in the order of the columns after the muscles.
  std::vector<double> peak_actuator_forces;
  std::vector<std::string> warnings;
};

}  // namespace gaitmill

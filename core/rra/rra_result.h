#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/data/model_spec.h"
#include "core/data/time_series.h"
#include "core/rra/rra_options.h"

namespace gaitmill {

/// Sum of the residual actuators in ground axes: forces at their points, torques against the
/// ground.
struct ResidualSum {
  Eigen::Vector3d force = Eigen::Vector3d::Constant(-1);   ///< [N]
  Eigen::Vector3d moment = Eigen::Vector3d::Constant(-1);  ///< [N.m]
};

/// What a pass recommended and did to the model.
struct MassAdjustment {
  ResidualSum average_before;  ///< inverse dynamics of the desired motion, model as received
  ResidualSum average_after;   ///< the same with the shifted mass center
  double shift_x = 0;          ///< dx [m]: the body's mass center moves to x - dx, z - dz
  double shift_z = 0;
  bool shift_limited = false;  ///< a shift was cut to the limit
  double mass_before = -1;     ///< [kg] whole body
  double mass_change = 0;      ///< [kg] recommended; applied if the options say so
  double mass_after = -1;      ///< [kg]
};

/// Largest deviations from the desired (filtered) motion over the tracked coordinates.
struct TrackingStatistics {
  double max_deg = -1;
  double max_rms_deg = -1;
  double max_cm = -1;
  double max_rms_cm = -1;
  std::string worst_rotation;     ///< coordinate of max_deg
  std::string worst_translation;  ///< coordinate of max_cm
};

/// Residuals of the simulated motion.
struct ResidualStatistics {
  ResidualSum average;  ///< time integral over duration
  ResidualSum peak;     ///< largest magnitude of each component
  ResidualSum rms;
};

/// Work done, for benchmarks and reports.
struct RraCounters {
  int windows = 0;
  int steps = 0;            ///< integration steps accepted
  int rejected_steps = 0;   ///< repeated with half the length
  int bounded_windows = 0;  ///< windows in which a control met its limit
};

/// One pass: simulation of the model as received with its mass center shifted; afterwards the mass
/// is changed. Tables have one row per control window, from start_time to end_time less one window.
struct RraPassResult {
  RraPassOptions used;  ///< tasks and time range as used
  MassAdjustment adjustment;
  TrackingStatistics tracking;
  ResidualStatistics residuals;
  RraCounters counters;
  TimeSeries coordinates;      ///< all coordinates of the model [rad|m]
  TimeSeries speeds;           ///< all coordinates
  TimeSeries actuator_forces;  ///< [N|N.m]
  TimeSeries residual_sums;    ///< force_x..z [N], moment_x..z [N.m] as ResidualSum
  TimeSeries tracking_errors;  ///< desired minus simulated, free coordinates [rad|m]
  ModelSpec adjusted_model;    ///< after this pass: mass center shifted, masses changed
};

struct RraResult {
  std::vector<RraPassResult> passes;  ///< at least one
  bool converged = false;             ///< the last pass changed less than the tolerances
  RraOptions options;                 ///< as asked
};

}  // namespace gaitmill

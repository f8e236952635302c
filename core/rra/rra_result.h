#pragma once

#include <cstddef>
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

/// Residuals over a time.
struct ResidualStatistics {
  ResidualSum average;  ///< time integral over duration
  ResidualSum peak;     ///< largest magnitude of each component
  ResidualSum rms;
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
  bool mass_limited = false;   ///< the mass change was cut to the limit
  ResidualStatistics desired;  ///< inverse dynamics that `average_after` is the average of
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

/// How far one coordinate strays from the desired motion.
struct CoordinateDeviation {
  std::string coordinate;
  bool translation = false;
  double rms = -1;    ///< [rad|m]
  double peak = -1;   ///< [rad|m]
  double share = -1;  ///< the larger of RMS and peak, each over its limit
};

/// A task weight that differs from the pass that the present one set out from, and why.
struct WeightChange {
  std::string coordinate;
  double before = -1;
  double after = -1;
  std::string reason;
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
/// Passes of the autopilot that it did not keep have empty tables and an empty model.
struct RraPassResult {
  RraPassOptions used;  ///< tasks and time range as used
  int from_pass = 0;    ///< whose weights were changed for this one, from 1; 0 = the options'
  std::vector<WeightChange> weight_changes;
  double merit = -1;     ///< sum of what deviations and residuals exceed their limits by, 0 = none
  std::string decision;  ///< what the pass showed and what follows from it, one sentence
  MassAdjustment adjustment;
  TrackingStatistics tracking;
  std::vector<CoordinateDeviation> deviations;  ///< of the free coordinates
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
  /// Listed passes: the last one changed less than the tolerances. Autopilot: the one that is kept
  /// holds all limits.
  bool converged = false;
  RraOptions options;  ///< as asked, limits resolved
  int kept = -1;       ///< position of the pass whose motion and model are the result
  /// Autopilot: steps that settled mass and mass center before the first pass.
  std::vector<MassAdjustment> mass_steps;
  std::vector<std::string> warnings;

  const RraPassResult& keptPass() const { return passes[static_cast<std::size_t>(kept)]; }
};

}  // namespace gaitmill

#pragma once

#include <string>
#include <vector>

#include "core/cmc/cmc_options.h"
#include "core/data/time_series.h"

namespace gaitmill {

/// A window in which the actuators could not give the desired accelerations. The forces are then
/// those that come closest; the simulation goes on.
struct InfeasibleWindow {
  struct Missing {
    std::string coordinate;
    double force = 0;  ///< demanded minus given generalized force [N.m|N]
  };
  double time = 0;               ///< start of the window [s]
  std::vector<Missing> missing;  ///< coordinates short by more than 1e-3, in model order
};

enum class CmcStop {
  kFinished,
  kDiverged,  ///< coordinates ran away: the tables end before the end time
};

/// Work done, for benchmarks and reports.
struct CmcCounters {
  int windows = 0;
  int qp_iterations = 0;
  long predictions = 0;       ///< muscle integrations over a window
  long fiber_steps = 0;       ///< implicit steps of these
  long rejected_steps = 0;    ///< of which were repeated with a shorter step
  long path_evaluations = 0;  ///< all muscle paths at one pose
};

/// What a CMC run produced. All tables but the tracking error have one row per integration step and
/// share their time axis; the first row is the start of the simulation.
struct CmcResult {
  // Columns: muscles of the model.
  TimeSeries excitation;           ///< [-] applied on the interval that ends at the row
  TimeSeries activation;           ///< [-]
  TimeSeries fiber_length;         ///< [m]
  TimeSeries norm_fiber_velocity;  ///< v/(l0M vmax) [-]
  TimeSeries tendon_force;         ///< [N]
  TimeSeries passive_fiber_force;  ///< along the tendon, damping included [N]
  TimeSeries path_length;          ///< [m]
  // Columns: the model's own actuators, then those of the options.
  TimeSeries actuator_force;  ///< [N|N.m]
  // Columns: coordinates of the model, dependent and locked ones included.
  TimeSeries pose;   ///< q [rad|m]
  TimeSeries speed;  ///< u
  // Columns: free coordinates.
  TimeSeries muscle_moment;   ///< sum over muscles of moment arm times tendon force [N.m|N]
  TimeSeries tracking_error;  ///< q_ref - q at t_start and at every window's start [rad|m]

  CmcStop stop = CmcStop::kFinished;
  std::vector<InfeasibleWindow> infeasible_windows;
  CmcCounters counters;
  CmcOptions options;  ///< as used
};

}  // namespace gaitmill

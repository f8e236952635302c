#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/units.h"
#include "core/data/model_spec.h"

namespace gaitmill {

/// How closely one coordinate is to be followed.
struct TrackingTask {
  std::string coordinate;
  double weight = 1;           ///< of the squared acceleration error, against (F / F_opt)^2
  double position_gain = 100;  ///< k_p [1/s^2]
  double velocity_gain = 20;   ///< k_v [1/s]; 2 sqrt(k_p) damps critically
};

/// What changes from pass to pass.
struct RraPassOptions {
  double start_time = 0;  ///< [s] clipped to the recorded motion
  double end_time = 0;    ///< [s] the simulation ends one window earlier
  std::vector<TrackingTask> tasks;
};

/// What a pass should hold: the acceptable column of spec/rra.md 6. Of every coordinate, and of
/// every component of the residuals.
struct RraLimits {
  double rotation_rms = 2 * kRadiansPerDegree;   ///< [rad]
  double rotation_peak = 5 * kRadiansPerDegree;  ///< [rad]
  double translation_rms = 0.02;                 ///< [m]
  double translation_peak = 0.05;                ///< [m]
  double force_rms = 15;                         ///< [N]
  double force_peak = 25;                        ///< [N] or the share below, whichever is larger
  double force_peak_share = 0.05;  ///< of the largest vertical ground reaction (Hicks et al. 2015)
  double moment_rms = 50;          ///< [N.m]
  double moment_peak = 75;         ///< [N.m]
};

enum class RraStrategy {
  kPasses,     ///< as listed: each shifts the mass center, simulates, changes the mass
  kAutopilot,  ///< mass and mass center first, then weights from pass to pass (rra_autopilot.h)
};

/// Residual reduction (spec/rra.md).
struct RraOptions {
  RraStrategy strategy = RraStrategy::kPasses;
  RraLimits limits;
  /// Share of the mass by which the autopilot may change it. More has another cause than the mass.
  double max_mass_change = 0.1;
  /// In order; the last one is repeated if there are more passes than entries. The autopilot starts
  /// from the first.
  std::vector<RraPassOptions> passes;
  /// Passes in all; 0 = as many as `passes` has.
  int max_passes = 0;
  /// After every entry of `passes` was used once: stop when a pass changed less than both. 0 =
  /// never.
  double mass_tolerance = 0;         ///< [kg] |mass change|
  double mass_center_tolerance = 0;  ///< [m] of either shift

  /// Low-pass of the desired motion [Hz], 101 taps (spec/signal.md 5.2). None = only padded.
  std::optional<double> lowpass_cutoff = 6;
  std::string lowpass_reason;  ///< why this one, for the audit
  int padding_rows = 60;       ///< reflected rows at each end before the filter

  /// Residual forces and torques, and one actuator per joint coordinate: as many as free
  /// coordinates. Forces at points are residual forces, torques against the ground residual
  /// moments.
  std::vector<ActuatorSpec> actuators;

  std::string adjusted_body = "torso";  ///< whose mass center is shifted
  double max_mass_center_shift =
      0.1;  ///< [m] along x and z each, per pass; of the autopilot in all
  bool adjust_mass_center = true;
  bool adjust_mass = true;
  /// Inertias keep their values when masses change: the published procedure.
  InertiaScaling inertia_scaling = InertiaScaling::kKeep;

  double window = 0.001;                ///< [s] between two controls
  double integration_tolerance = 1e-7;  ///< [rad|m, and per 0.01 s] error of one step

  /// @throws Error kSettingsValue naming the field
  void validate() const;
};

}  // namespace gaitmill

#pragma once

#include <string>
#include <vector>

#include "core/data/model_spec.h"

namespace gaitmill {

/// Time-varying upper limit of one muscle's excitation. A node's value holds on the interval that
/// ends at it, (t_k-1, t_k]; the first value before, the last one after (spec/cmc.md 1). Times
/// within 1e-9 s of a node count as after it.
struct ExcitationLimit {
  struct Node {
    double time = 0;   ///< [s]
    double upper = 1;  ///< [-]
  };
  std::string muscle;
  std::vector<Node> nodes;  ///< at least one, times increasing
};

enum class CmcQpSolver {
  kDual,   ///< exact, allocation-free
  kIpopt,  ///< interior point, some milliseconds per window; for comparison
};

/// Computed muscle control (spec/cmc.md). Task weights do not occur: accelerations are exact
/// constraints, which weights would only scale.
struct CmcOptions {
  double start_time = 0;  ///< [s] start of the initial stage; the simulation begins 30 ms later
  double end_time = 0;    ///< [s] the simulation ends one window earlier
  double window = 0.010;  ///< [s] between two excitations
  double initial_window = 0.030;  ///< [s] of the initial stage
  double hold_duration = 0.2;     ///< [s] muscles settle at a frozen pose, three times
  double hold_excitation = 0.01;  ///< [-] in the first of these
  double position_gain = 100;     ///< k_p [1/s^2]
  double velocity_gain = 20;      ///< k_v [1/s]
  double min_excitation = 0.02;   ///< [-]
  double max_excitation = 1.0;    ///< [-]
  std::vector<ExcitationLimit> excitation_limits;

  /// Residuals and reserves, in addition to the model's own torque actuators. Their cost is
  /// (F/F_opt)^2; min_control and max_control bound them.
  std::vector<ActuatorSpec> actuators;
  /// Bounds of the controls of the model's own actuators, in place of those of the document [-].
  double torque_control_limit = 1000;

  /// Start the elastic fibers from rest at the default pose, else from their default lengths.
  bool equilibrate_at_default_pose = true;
  double uncontrollable_range = 1.0;   ///< [N] below which a muscle keeps its lower excitation
  double excitation_tolerance = 1e-6;  ///< [-] of the search for excitations
  double fiber_tolerance = 1e-6;       ///< [l0M] error per step of predicted fiber lengths
  double integration_step = 0.0025;    ///< [s] longest step of the forward simulation
  CmcQpSolver qp_solver = CmcQpSolver::kDual;
  /// Logarithmic barrier that keeps forces off their bounds, in units of the cost; 0 = exact. The
  /// published runs end at this value (spec/cmc.md 3.6). It also lets slack tendons be taken up
  /// before their muscle is needed.
  double barrier = 1e-5;

  /// @throws Error kSettingsValue naming the field
  void validate() const;
};

}  // namespace gaitmill

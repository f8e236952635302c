#pragma once

#include <vector>

#include "core/data/marker_set.h"
#include "core/data/model_spec.h"

namespace gaitmill {

/// What static optimization is asked for (spec/so.md).
struct SoOptions {
  /// What a muscle can do at full activation.
  enum class Capacity {
    kForceLengthVelocity,  ///< F0M fL fV cos(alpha) with an inextensible tendon
    kIsometric,            ///< F0M, whatever its length and speed
  };
  /// Whether stretched fibers carry load by themselves. OpenSim leaves them out.
  enum class PassiveForce { kOff, kOn };

  /// Both give the same answer; the interior point is the slower cross-check.
  enum class Solver { kDualNewton, kIpopt };

  double exponent = 2;  ///< p >= 1 of the cost sum |a|^p; > 1 for Ipopt
  Solver solver = Solver::kDualNewton;
  Capacity capacity = Capacity::kForceLengthVelocity;
  PassiveForce passive_force = PassiveForce::kOff;
  /// Residuals and reserves, in addition to the model's own torque actuators. Their control counts
  /// in the cost like an activation, and is bounded by min_control and max_control.
  std::vector<ActuatorSpec> actuators;
  TimeRange range;       ///< rows nearest to both ends, inclusive [s]
  int row_interval = 1;  ///< every n-th row of the coordinates

  /// A row is reported as infeasible when more than this is missing [N|N.m].
  double infeasible_above = 1e-3;

  /// @throws Error kInputValue naming the first option out of range
  void validate() const;
};

}  // namespace gaitmill

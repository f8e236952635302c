#pragma once

#include "core/analysis/force_record.h"
#include "core/data/time_series.h"
#include "core/math/events.h"
#include "core/model/model.h"

namespace gaitmill {

/// Energy of the whole body and who changes it, on the rows of the record:
///   d(kinetic_energy + potential_energy)/dt
///     = muscle_power + actuator_power + residual_power + ground_power
/// Columns kinetic_energy, potential_energy [J] and the powers [W]: of all muscles (-F dL/dt), of
/// the actuators of coordinates (torque actuators, reserves), of the residual forces and torques on
/// bodies, and of the ground reactions.
TimeSeries calcBodyPowers(const Model& model, const ForceRecord& record);

/// The same over an interval: what each did [J].
struct WorkBalance {
  double start = 0;  ///< [s]
  double end = 0;
  double muscles = 0;
  double actuators = 0;
  double residuals = 0;
  double ground = 0;
  double energy_change = 0;  ///< of kinetic and potential energy
  /// Energy change that no force accounts for: 0 for a simulation whose rows are dense enough.
  double imbalance() const { return energy_change - muscles - actuators - residuals - ground; }
};

/// Trapezoids between rows. @param interval  inside the table
WorkBalance calcWorkBalance(const TimeSeries& body_powers, const GaitCycle& interval);

}  // namespace gaitmill

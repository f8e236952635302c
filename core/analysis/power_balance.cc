#include "core/analysis/power_balance.h"

#include "core/analysis/force_replay.h"
#include "core/analysis/work.h"

namespace gaitmill {

namespace {

enum Column { kKinetic, kPotential, kMuscles, kActuators, kResiduals, kGroundPower };

}  // namespace

TimeSeries calcBodyPowers(const Model& model, const ForceRecord& record) {
  ForceReplay replay(model, record);
  TimeSeries table = makeTimeSeries("body_powers",
                                    {"kinetic_energy",
                                     "potential_energy",
                                     "muscle_power",
                                     "actuator_power",
                                     "residual_power",
                                     "ground_power"},
                                    replay.times());
  table.units = {"J", "J", "W", "W", "W", "W"};
  for (int row = 0; row < replay.rowCount(); ++row) {
    replay.setRow(row);
    const ForceReplay::Powers powers = replay.calcPowers();
    table.values.row(row) << replay.state().calcKineticEnergy(),
        replay.state().calcPotentialEnergy(), powers.muscles, powers.actuators, powers.residuals,
        powers.ground;
  }
  return table;
}

WorkBalance calcWorkBalance(const TimeSeries& body_powers, const GaitCycle& interval) {
  const TimeSeries rows = cutInterval(body_powers, interval.start, interval.end);
  const auto work = [&](int column) {
    const SignedWork parts = integratePower(rows, column);
    return parts.positive + parts.negative;
  };
  const auto energy = [&](int row) {
    return rows.values(row, kKinetic) + rows.values(row, kPotential);
  };
  WorkBalance balance;
  balance.start = interval.start;
  balance.end = interval.end;
  balance.muscles = work(kMuscles);
  balance.actuators = work(kActuators);
  balance.residuals = work(kResiduals);
  balance.ground = work(kGroundPower);
  balance.energy_change = energy(rows.rowCount() - 1) - energy(0);
  return balance;
}

}  // namespace gaitmill

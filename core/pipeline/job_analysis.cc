#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/analysis/joint_reactions.h"
#include "core/analysis/work.h"
#include "core/model/external_loads.h"
#include "core/model/free_coordinates.h"
#include "core/model/model.h"
#include "core/pipeline/job.h"

namespace gaitmill {

namespace {

/// What the muscles did according to the stage.
MuscleRecord recordMuscles(Stage stage, const Job& job) {
  if (stage == Stage::kCmc) {
    const CmcResult& cmc = *job.cmc;
    return {FiberSource::kSimulated,
            cmc.pose,
            cmc.speed,
            cmc.activation,
            cmc.tendon_force,
            &cmc.fiber_length};
  }
  const SoResult& so = *job.so;
  const bool passive = job.settings.so.passive_force == SoOptions::PassiveForce::kOn;
  return {passive ? FiberSource::kRigidWithPassive : FiberSource::kRigidActive,
          so.pose,
          so.speed,
          so.activations,
          so.forces,
          nullptr};
}

/// The motion and forces of the stage. Both kinds of result name their actuators, the model's own
/// first.
ForceRecord recordForces(Stage stage, const Job& job, const ExternalLoads& loads) {
  std::vector<ActuatorSpec> actuators = job.adjusted.actuators;
  const std::vector<ActuatorSpec> added =
      stage == Stage::kCmc ? job.cmc->options.actuators
                           : makeActuators(job.settings.so_actuators, job.adjusted);
  actuators.insert(actuators.end(), added.begin(), added.end());
  if (stage == Stage::kCmc) {
    const CmcResult& cmc = *job.cmc;
    return {cmc.pose, cmc.speed, cmc.tendon_force, cmc.actuator_force, actuators, loads};
  }
  const SoResult& so = *job.so;
  return {so.pose, so.speed, so.forces, so.forces, actuators, loads};
}

/// Right cycles as settings or forces have them.
std::vector<GaitCycle> listCycles(const Job& job) {
  if (job.settings.gait_cycle) {
    return {*findGaitCycle(job)};
  }
  return findGaitCycles(job, Foot::kRight);
}

WorkBalance balanceWork(const Job& job, const TimeSeries& powers) {
  GaitCycle interval{powers.time.front(), powers.time.back()};
  if (const std::optional<GaitCycle> cycle = findGaitCycle(job)) {
    interval = findCoveredCycle(*cycle, interval.start, interval.end).value_or(interval);
  }
  interval.end = std::min(interval.end, powers.time.back());
  return calcWorkBalance(powers, interval);
}

/// Where a coupler hangs a coordinate on another, inverse dynamics gives what both need together.
TimeSeries makeJointPowers(const Job& job) {
  const IdResult& id = *job.id;
  const Model model(job.adjusted);
  const FreeCoordinates free(model);
  TimeSeries powers = makeTimeSeries("joint_powers", {}, id.generalized_forces.time);
  std::vector<std::string> forces;
  for (const CoordinateIndex c : free.indices()) {
    const std::string& name = model.coordinate(c).name;
    const bool slides = model.motionKind(c) == MotionKind::kTranslational;
    forces.push_back(name + (slides ? "_force" : "_moment"));
    for (const CouplerSpec& coupler : job.adjusted.couplers) {
      if (coupler.enforced && coupler.independent == name) {
        forces.back() += "_with_" + coupler.dependent;
      }
    }
    powers.labels.push_back(name + "_power");
  }
  powers.units.assign(powers.labels.size(), "W");
  powers.values.resize(powers.rowCount(), powers.columnCount());
  for (int column = 0; column < powers.columnCount(); ++column) {
    const int force = id.generalized_forces.getColumn(forces[static_cast<std::size_t>(column)]);
    const int speed = free.indices()[static_cast<std::size_t>(column)].value();
    powers.values.col(column) =
        id.generalized_forces.values.col(force).cwiseProduct(id.speeds.values.col(speed));
  }
  return powers;
}

/// The stage whose muscle forces count: CMC where it runs, else static optimization.
bool settlesMuscles(Stage stage, const PipelineSettings& settings) {
  return stage == Stage::kCmc || (stage == Stage::kSo && !settings.runs(Stage::kCmc));
}

/// The first stage that uses the ground reactions.
bool isFirstWithForces(Stage stage, const PipelineSettings& settings) {
  for (Stage one : {Stage::kRra, Stage::kId, Stage::kSo, Stage::kCmc}) {
    if (settings.runs(one)) {
      return stage == one;
    }
  }
  return false;
}

void addMuscles(const MuscleAnalysis& muscles, StageOutcome& outcome) {
  for (const TimeSeries* table : {&muscles.active_fiber_forces,
                                  &muscles.passive_fiber_forces,
                                  &muscles.norm_fiber_lengths,
                                  &muscles.norm_fiber_velocities,
                                  &muscles.pennation_angles,
                                  &muscles.fiber_active_powers,
                                  &muscles.fiber_passive_powers,
                                  &muscles.tendon_powers,
                                  &muscles.muscle_powers,
                                  &muscles.muscle_moments}) {
    outcome.tables[table->name] = *table;
  }
}

}  // namespace

void analyze(Stage stage, Job& job) {
  // A simulation that ran away has nothing to analyse.
  const bool diverged = stage == Stage::kCmc && job.cmc->stop == CmcStop::kDiverged;
  if (!settlesMuscles(stage, job.settings) || diverged) {
    return;
  }
  const Model model(job.adjusted);
  JobAnalysis analysis;
  analysis.muscles = analyzeMuscles(model, recordMuscles(stage, job));
  const ExternalLoads loads(model, job.reaction);
  const ForceRecord forces = recordForces(stage, job, loads);
  analysis.joint_reactions = calcJointReactions(model, forces);
  analysis.balance = balanceWork(job, calcBodyPowers(model, forces));
  analysis.muscle_work = calcMuscleWork(analysis.muscles, listCycles(job));
  job.analysis = std::move(analysis);
}

void addAnalysis(Stage stage, const Job& job, StageOutcome& outcome) {
  if (stage == Stage::kIk) {
    outcome.tables["measured_markers"] = makeMeasuredMarkers(job);
  }
  if (stage == Stage::kId) {
    outcome.tables["joint_powers"] = makeJointPowers(job);
  }
  if (isFirstWithForces(stage, job.settings)) {
    outcome.tables["ground_reactions"] = makeGroundReactions(job);
  }
  if (settlesMuscles(stage, job.settings) && job.analysis) {
    addMuscles(job.analysis->muscles, outcome);
    outcome.tables["joint_reactions"] = job.analysis->joint_reactions;
    if (job.analysis->muscle_work.rowCount() > 0) {
      outcome.tables["muscle_work"] = job.analysis->muscle_work;
    }
  }
}

}  // namespace gaitmill

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "core/analysis/acceptance.h"
#include "core/base/error.h"
#include "core/io/osim_writer.h"
#include "core/io/table_writer.h"
#include "core/math/events.h"
#include "core/pipeline/job.h"
#include "core/pipeline/job_emg.h"
#include "core/pipeline/rra_audit.h"

namespace gaitmill {

namespace {

/// Joins tables of one time axis side by side.
TimeSeries joinColumns(const std::string& name, const TimeSeries& left, const TimeSeries& right) {
  TimeSeries joined = left;
  joined.name = name;
  joined.labels.insert(joined.labels.end(), right.labels.begin(), right.labels.end());
  joined.units.insert(joined.units.end(), right.units.begin(), right.units.end());
  joined.values.resize(left.rowCount(), left.columnCount() + right.columnCount());
  joined.values << left.values, right.values;
  return joined;
}

TimeSeries pickColumns(const std::string& name,
                       const TimeSeries& table,
                       const std::vector<std::string>& labels) {
  TimeSeries picked = makeTimeSeries(name, {}, table.time);
  for (const std::string& label : labels) {
    if (const std::optional<int> column = table.findColumn(label)) {
      picked.labels.push_back(label);
      picked.units.push_back(table.units.empty() ? ""
                                                 : table.units[static_cast<std::size_t>(*column)]);
      picked.values.conservativeResize(table.rowCount(), picked.columnCount());
      picked.values.col(picked.columnCount() - 1) = table.values.col(*column);
    }
  }
  return picked;
}

/// The rows of a table that lie in [start, end]; at least one.
TimeSeries copyCovered(const TimeSeries& table, double start, double end) {
  int first = 0;
  int last = table.rowCount() - 1;
  while (first < last && table.time[static_cast<std::size_t>(first)] < start) {
    ++first;
  }
  while (last > first && table.time[static_cast<std::size_t>(last)] > end) {
    --last;
  }
  return table.copyRows(first, last);
}

/// Moments of inverse dynamics, and beside them what the muscles make of them where CMC ran: on the
/// rows of inverse dynamics that CMC covers.
TimeSeries makeMoments(const Job& job) {
  TimeSeries moments = job.id->generalized_forces;
  moments.name = "moments";
  if (!job.cmc) {
    return moments;
  }
  const TimeSeries& muscle = job.cmc->muscle_moment;
  moments = copyCovered(moments, muscle.time.front(), muscle.time.back());
  // Pelvis and arms have no muscles: columns that are zero throughout say nothing.
  TimeSeries beside = makeTimeSeries("muscle_moments", {}, moments.time);
  std::vector<int> columns;
  for (int column = 0; column < muscle.columnCount(); ++column) {
    if (!muscle.values.col(column).isZero(0.0)) {
      beside.labels.push_back(muscle.labels[static_cast<std::size_t>(column)] + "_muscle_moment");
      beside.units.emplace_back("N.m");
      columns.push_back(column);
    }
  }
  beside.values.resize(moments.rowCount(), beside.columnCount());
  for (int row = 0; row < moments.rowCount(); ++row) {
    const Eigen::VectorXd at_row = muscle.interpolate(moments.time[static_cast<std::size_t>(row)]);
    for (int column = 0; column < beside.columnCount(); ++column) {
      beside.values(row, column) = at_row[columns[static_cast<std::size_t>(column)]];
    }
  }
  return joinColumns("moments", moments, beside);
}

std::string writeMotion(const TimeSeries& coordinates, const ModelSpec& model) {
  TableWriteOptions options;
  options.angles = AngleUnit::kDegrees;
  options.model = &model;
  return writeTable(coordinates, options);
}

/// Forces of the residual actuators, named FX ... MZ.
TimeSeries pickResiduals(const TimeSeries& actuator_forces) {
  return pickColumns("residuals", actuator_forces, {"FX", "FY", "FZ", "MX", "MY", "MZ"});
}

/// Forces of the actuators that were added to joints, beside the model's own.
TimeSeries pickReserves(const TimeSeries& forces, const std::vector<ActuatorSpec>& actuators) {
  std::vector<std::string> names;
  for (const ActuatorSpec& actuator : actuators) {
    if (actuator.kind == ActuatorSpec::Kind::kCoordinate) {
      names.push_back(actuator.name);
    }
  }
  return pickColumns("reserves", forces, names);
}

/// Fiber velocities in metres per second, lengthening positive.
TimeSeries makeFiberVelocities(const Job& job) {
  TimeSeries velocities = job.cmc->norm_fiber_velocity;
  velocities.name = "fiber_velocities";
  for (int column = 0; column < velocities.columnCount(); ++column) {
    const int muscle = job.adjusted.findMuscle(velocities.labels[static_cast<std::size_t>(column)]);
    check(muscle >= 0, "a fiber velocity belongs to no muscle");
    const MuscleSpec& spec = job.adjusted.muscles[static_cast<std::size_t>(muscle)];
    velocities.values.col(column) *= spec.optimal_fiber_length * spec.max_contraction_velocity;
  }
  velocities.units.assign(velocities.labels.size(), "m/s");
  return velocities;
}

void addScale(const Job& job, StageOutcome& outcome) {
  outcome.files["scaled_model.osim"] = writeOsim(job.scaled);
  outcome.files["adjusted_model.osim"] = writeOsim(job.adjusted);
}

void addIk(const Job& job, StageOutcome& outcome) {
  outcome.tables["kinematics"] = job.motion;
  outcome.tables["marker_errors"] = job.ik->marker_errors;
  outcome.files["ik.mot"] = writeMotion(job.ik->coordinates, job.scaled);
  outcome.files["ik_marker_errors.sto"] = writeTable(job.ik->errors);
  outcome.files["ik_marker_distances.sto"] = writeTable(job.ik->marker_errors);
}

void addRra(const Job& job, StageOutcome& outcome) {
  outcome.tables["kinematics"] = job.motion;
  outcome.tables["residuals"] = pickResiduals(job.rra->keptPass().actuator_forces);
  outcome.tables["tracking_errors"] = job.rra->keptPass().tracking_errors;
  outcome.files["rra.mot"] = writeMotion(job.motion, job.scaled);
  outcome.files["rra_audit.json"] = auditRra(*job.rra).dump(2) + "\n";
  outcome.files["adjusted_model.osim"] = writeOsim(job.adjusted);
}

void addId(const Job& job, StageOutcome& outcome) {
  if (!job.ik && !job.rra) {
    outcome.tables["kinematics"] = job.motion;
  }
  outcome.tables["moments"] = makeMoments(job);
  outcome.files["inverse_dynamics.sto"] = writeTable(job.id->generalized_forces);
  outcome.files["moments.csv"] = writeCsv(outcome.tables["moments"]);
}

void addSo(const Job& job, StageOutcome& outcome) {
  if (!job.ik && !job.rra && !job.id) {
    outcome.tables["kinematics"] = job.motion;
  }
  outcome.tables["activations"] = job.so->activations;
  outcome.tables["forces"] = job.so->forces;
  outcome.tables["reserves"] =
      pickReserves(job.so->forces, makeActuators(job.settings.so_actuators, job.adjusted));
  outcome.files["so_activations.sto"] = writeTable(job.so->activations);
  outcome.files["so_forces.sto"] = writeTable(job.so->forces);
}

void addCmc(const Job& job, StageOutcome& outcome) {
  const CmcResult& cmc = *job.cmc;
  outcome.tables["activations"] = cmc.activation;
  outcome.tables["excitations"] = cmc.excitation;
  outcome.tables["forces"] = joinColumns("forces", cmc.tendon_force, cmc.actuator_force);
  outcome.tables["fiber_lengths"] = cmc.fiber_length;
  outcome.tables["fiber_velocities"] = makeFiberVelocities(job);
  outcome.tables["kinematics"] = cmc.pose;
  outcome.tables["residuals"] = pickResiduals(cmc.actuator_force);
  outcome.tables["tracking_errors"] = cmc.tracking_error;
  outcome.tables["reserves"] = pickReserves(cmc.actuator_force, cmc.options.actuators);
  if (job.id) {
    outcome.tables["moments"] = makeMoments(job);
    outcome.files["moments.csv"] = writeCsv(outcome.tables["moments"]);
  }
  outcome.files["cmc_activations.sto"] = writeTable(cmc.activation);
  outcome.files["cmc_excitations.sto"] = writeTable(cmc.excitation);
  outcome.files["cmc_forces.sto"] = writeTable(outcome.tables["forces"]);
  outcome.files["cmc_fiber_lengths.sto"] = writeTable(cmc.fiber_length);
  outcome.files["cmc_kinematics.mot"] = writeMotion(cmc.pose, job.adjusted);
}

void addStage(Stage stage, const Job& job, StageOutcome& outcome) {
  switch (stage) {
    case Stage::kScale:
      return addScale(job, outcome);
    case Stage::kIk:
      return addIk(job, outcome);
    case Stage::kRra:
      return addRra(job, outcome);
    case Stage::kId:
      return addId(job, outcome);
    case Stage::kSo:
      return addSo(job, outcome);
    case Stage::kCmc:
      return addCmc(job, outcome);
  }
}

}  // namespace

StageOutcome makeOutcome(Stage stage, const Job& job) {
  StageOutcome outcome;
  outcome.stage = stage;
  addStage(stage, job, outcome);
  addAnalysis(stage, job, outcome);
  addEmg(stage, job, outcome);
  const std::optional<GaitCycle> cycle = findGaitCycle(job);
  for (auto entry = outcome.tables.begin(); entry != outcome.tables.end();) {
    auto& [name, table] = *entry;
    table.name = name;
    check(table.units.size() == table.labels.size(), "a result has columns without unit");
    // Work is one row per cycle already; some stages bring their own cycle.
    const bool has_rows = table.rowCount() > 1 && table.columnCount() > 0;
    const bool is_done = name == "muscle_work" || outcome.cycle_tables.count(name) > 0;
    if (cycle && has_rows && !is_done) {
      outcome.cycle_tables[name] = normalizeToCycle(table, *cycle);
    }
    entry = table.labels.empty() ? outcome.tables.erase(entry) : std::next(entry);
  }
  return outcome;
}

}  // namespace gaitmill

#include <algorithm>
#include <cmath>
#include <string>

#include "core/analysis/acceptance.h"
#include "core/io/osim_writer.h"
#include "core/io/table_writer.h"
#include "core/math/events.h"
#include "core/pipeline/job.h"

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

/// Coordinates as later stages saw them.
const TimeSeries& findKinematics(const Job& job) {
  return job.cmc ? job.cmc->pose : job.motion;
}

std::string writeMotion(const TimeSeries& coordinates, const ModelSpec& model) {
  TableWriteOptions options;
  options.angles = AngleUnit::kDegrees;
  options.model = &model;
  return writeTable(coordinates, options);
}

void addStageTables(const Job& job, PipelineResult& result) {
  if (job.id) {
    result.tables["moments"] = makeMoments(job);
  }
  if (job.cmc) {
    result.tables["activations"] = job.cmc->activation;
    result.tables["excitations"] = job.cmc->excitation;
    result.tables["forces"] = joinColumns("forces", job.cmc->tendon_force, job.cmc->actuator_force);
  } else if (job.so) {
    result.tables["activations"] = job.so->activations;
    result.tables["forces"] = job.so->forces;
  }
  if (!job.motion.time.empty()) {
    result.tables["kinematics"] = findKinematics(job);
  }
  const std::vector<std::string> residuals = {"FX", "FY", "FZ", "MX", "MY", "MZ"};
  if (job.cmc) {
    result.tables["residuals"] = pickColumns("residuals", job.cmc->actuator_force, residuals);
  } else if (job.rra) {
    result.tables["residuals"] =
        pickColumns("residuals", job.rra->passes.back().actuator_forces, residuals);
  }
}

}  // namespace

std::optional<GaitCycle> findGaitCycle(const Job& job) {
  if (job.settings.gait_cycle) {
    return GaitCycle{job.settings.gait_cycle->start, job.settings.gait_cycle->end};
  }
  std::vector<double> strikes;
  for (const ExternalForce& force : job.reaction.forces) {
    if (force.body != job.settings.forces.reading.right_body) {
      continue;
    }
    for (const Contact& contact : findContacts(job.reaction.time, force.force.row(1).transpose())) {
      if (contact.has_strike) {
        strikes.push_back(contact.strike);
      }
    }
  }
  std::sort(strikes.begin(), strikes.end());
  if (strikes.size() < 2) {
    return std::nullopt;
  }
  return GaitCycle{strikes[0], strikes[1]};
}

void addTables(const Job& job, PipelineResult& result) {
  addStageTables(job, result);
  const std::optional<GaitCycle> cycle = findGaitCycle(job);
  for (const auto& [name, table] : result.tables) {
    if (cycle && table.rowCount() > 1) {
      result.cycle_tables[name] = normalizeToCycle(table, *cycle);
    }
  }
}

void addFiles(const Job& job, PipelineResult& result) {
  std::map<std::string, std::string>& files = result.files;
  if (job.scale) {
    files["scaled_model.osim"] = writeOsim(job.scaled);
  }
  if (job.ik) {
    files["ik.mot"] = writeMotion(job.ik->coordinates, job.scaled);
    files["ik_marker_errors.sto"] = writeTable(job.ik->errors);
    files["ik_marker_distances.sto"] = writeTable(job.ik->marker_errors);
  }
  if (job.rra) {
    files["rra.mot"] = writeMotion(job.motion, job.scaled);
  }
  if (job.rra || job.scale) {
    files["adjusted_model.osim"] = writeOsim(job.adjusted);
  }
  if (job.id) {
    files["inverse_dynamics.sto"] = writeTable(job.id->generalized_forces);
    files["moments.csv"] = writeCsv(result.tables.at("moments"));
  }
  if (job.so) {
    files["so_activations.sto"] = writeTable(job.so->activations);
    files["so_forces.sto"] = writeTable(job.so->forces);
  }
  if (job.cmc) {
    files["cmc_activations.sto"] = writeTable(job.cmc->activation);
    files["cmc_excitations.sto"] = writeTable(job.cmc->excitation);
    files["cmc_forces.sto"] = writeTable(result.tables.at("forces"));
    files["cmc_fiber_lengths.sto"] = writeTable(job.cmc->fiber_length);
    files["cmc_kinematics.mot"] = writeMotion(job.cmc->pose, job.adjusted);
  }
}

}  // namespace gaitmill

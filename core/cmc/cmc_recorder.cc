#include "core/cmc/cmc_recorder.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace gaitmill {
namespace {

// Generalized forces below this count as given [N.m|N].
constexpr double kMissingForce = 1e-3;

std::vector<std::string> makeUnits(const Model& model, const std::vector<CoordinateIndex>& list) {
  std::vector<std::string> units;
  units.reserve(list.size());
  for (const CoordinateIndex c : list) {
    units.emplace_back(model.motionKind(c) == MotionKind::kTranslational ? "m" : "rad");
  }
  return units;
}

std::vector<CoordinateIndex> listCoordinates(const Model& model) {
  std::vector<CoordinateIndex> all;
  all.reserve(static_cast<std::size_t>(model.coordinateCount()));
  for (int c = 0; c < model.coordinateCount(); ++c) {
    all.emplace_back(c);
  }
  return all;
}

TimeSeries makeTable(const char* name,
                     const std::vector<std::string>& labels,
                     std::vector<std::string> units,
                     int rows) {
  TimeSeries table =
      makeTimeSeries(name, labels, std::vector<double>(static_cast<std::size_t>(rows), NAN));
  table.units = std::move(units);
  return table;
}

void trim(TimeSeries& table, int rows) {
  table.time.resize(static_cast<std::size_t>(rows));
  table.values.conservativeResize(rows, Eigen::NoChange);
}

}  // namespace

CmcRecorder::CmcRecorder(const Model& model,
                         const std::vector<Muscle>& muscles,
                         const Musculoskeleton& body,
                         int max_rows,
                         int max_windows)
    : model_(model), muscles_(muscles) {
  std::vector<std::string> muscle_names;
  for (const MuscleSpec& muscle : model.spec().muscles) {
    muscle_names.push_back(muscle.name);
  }
  const auto makeMuscleTable = [&](const char* name, const char* unit) {
    return makeTable(
        name, muscle_names, std::vector<std::string>(muscle_names.size(), unit), max_rows);
  };
  result_.excitation = makeMuscleTable("excitation", "");
  result_.activation = makeMuscleTable("activation", "");
  result_.fiber_length = makeMuscleTable("fiber_length", "m");
  result_.norm_fiber_velocity = makeMuscleTable("norm_fiber_velocity", "");
  result_.tendon_force = makeMuscleTable("tendon_force", "N");
  result_.passive_fiber_force = makeMuscleTable("passive_fiber_force", "N");
  result_.path_length = makeMuscleTable("path_length", "m");

  std::vector<std::string> actuator_names;
  std::vector<std::string> actuator_units;
  for (const ActuatorSpec& spec : body.actuators().specs()) {
    actuator_names.push_back(spec.name);
    const bool torque =
        spec.kind == ActuatorSpec::Kind::kTorque ||
        (spec.kind == ActuatorSpec::Kind::kCoordinate &&
         model.motionKind(model.getCoordinate(spec.coordinate)) != MotionKind::kTranslational);
    actuator_units.emplace_back(torque ? "N.m" : "N");
  }
  result_.actuator_force = makeTable("actuator_force", actuator_names, actuator_units, max_rows);

  const std::vector<std::string>& names = model.coordinateNames();
  std::vector<std::string> units = makeUnits(model, listCoordinates(model));
  result_.pose = makeTable("pose", names, units, max_rows);
  for (std::string& unit : units) {
    unit += "/s";
  }
  result_.speed = makeTable("speed", names, units, max_rows);

  const std::vector<CoordinateIndex>& free = body.free().indices();
  units = makeUnits(model, free);
  std::vector<std::string> force_units;
  for (std::size_t i = 0; i < free.size(); ++i) {
    free_names_.push_back(names[static_cast<std::size_t>(free[i].value())]);
    force_units.emplace_back(units[i] == "m" ? "N" : "N.m");
  }
  result_.muscle_moment = makeTable("muscle_moment", free_names_, force_units, max_rows);
  result_.tracking_error = makeTable("tracking_error", free_names_, units, max_windows + 1);
}

std::array<TimeSeries*, 11> CmcRecorder::findRowTables() {
  return {{&result_.excitation,
           &result_.activation,
           &result_.fiber_length,
           &result_.norm_fiber_velocity,
           &result_.tendon_force,
           &result_.passive_fiber_force,
           &result_.path_length,
           &result_.actuator_force,
           &result_.pose,
           &result_.speed,
           &result_.muscle_moment}};
}

void CmcRecorder::addRow(const CmcState& state,
                         const Eigen::VectorXd& excitation,
                         const ForwardIntegrator& integrator,
                         const Musculoskeleton& body) {
  const int row = rows_++;
  for (TimeSeries* table : findRowTables()) {
    table->time[static_cast<std::size_t>(row)] = state.time;
  }
  result_.excitation.values.row(row) = excitation.transpose();
  result_.activation.values.row(row) = state.activation.transpose();
  result_.path_length.values.row(row) = body.pathLengths().transpose();
  result_.tendon_force.values.row(row) = integrator.tendonForces().transpose();
  result_.actuator_force.values.row(row) = integrator.actuatorForces().transpose();
  result_.pose.values.row(row) = body.pose().transpose();
  result_.speed.values.row(row) = body.speed().transpose();
  result_.muscle_moment.values.row(row).noalias() =
      integrator.tendonForces().transpose() * body.momentArms();
  for (std::size_t m = 0; m < muscles_.size(); ++m) {
    const auto i = static_cast<Eigen::Index>(m);
    const FiberState fiber = muscles_[m].calcState(
        state.activation[i], state.fiber_length[i], body.pathLengths()[i], body.pathSpeeds()[i]);
    result_.fiber_length.values(row, i) = fiber.length;
    result_.norm_fiber_velocity.values(row, i) = fiber.norm_velocity;
    result_.passive_fiber_force.values(row, i) = fiber.passive_force * fiber.cos_pennation;
  }
}

void CmcRecorder::addTrackingError(double time, const Eigen::VectorXd& error) {
  result_.tracking_error.time[static_cast<std::size_t>(errors_)] = time;
  result_.tracking_error.values.row(errors_++) = error.transpose();
}

void CmcRecorder::addInfeasible(const CmcWindow& window) {
  InfeasibleWindow report;
  report.time = window.time;
  for (Eigen::Index i = 0; i < window.slack.size(); ++i) {
    if (std::abs(window.slack[i]) > kMissingForce) {
      report.missing.push_back({free_names_[static_cast<std::size_t>(i)], window.slack[i]});
    }
  }
  result_.infeasible_windows.push_back(std::move(report));
}

CmcResult CmcRecorder::take() {
  for (TimeSeries* table : findRowTables()) {
    trim(*table, rows_);
  }
  trim(result_.tracking_error, errors_);
  return std::move(result_);
}

}  // namespace gaitmill

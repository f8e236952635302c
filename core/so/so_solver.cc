#include "core/so/so_solver.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/math/ipopt_qp.h"

namespace gaitmill {

namespace {

/// Model documents write an infinite bound as a huge number.
constexpr double kUnbounded = 1e100;

/// Activation at which the interior point begins: inside every muscle's bounds.
constexpr double kIpoptStart = 0.1;

std::vector<ActuatorSpec> joinActuators(const ModelSpec& model, const SoOptions& options) {
  std::vector<ActuatorSpec> all = model.actuators;
  all.insert(all.end(), options.actuators.begin(), options.actuators.end());
  return all;
}

double openBound(double bound) {
  return std::abs(bound) < kUnbounded
             ? bound
             : std::copysign(std::numeric_limits<double>::infinity(), bound);
}

std::vector<int> findRows(const std::vector<double>& time, const SoOptions& options) {
  const TimeSeries axis{"coordinates", {}, {}, time, {}};
  require(!time.empty() && options.range.start <= time.back() && options.range.end >= time.front(),
          ErrorCode::kInputTimeRange,
          "no row of the coordinates lies in the time range",
          {{}, 0, 0, "time_range_s"});
  const int first = axis.findNearestRow(std::max(options.range.start, time.front()));
  const int last = axis.findNearestRow(std::min(options.range.end, time.back()));
  std::vector<int> rows;
  for (int row = first; row <= last; row += options.row_interval) {
    rows.push_back(row);
  }
  return rows;
}

TimeSeries makeMotionTable(const Model& model,
                           const char* name,
                           const std::string& per_time,
                           std::vector<double> time) {
  TimeSeries table = makeTimeSeries(name, model.coordinateNames(), std::move(time));
  for (int c = 0; c < model.coordinateCount(); ++c) {
    const bool slides = model.motionKind(CoordinateIndex(c)) == MotionKind::kTranslational;
    table.units.push_back((slides ? "m" : "rad") + per_time);
  }
  return table;
}

}  // namespace

SoSolver::SoSolver(const Model& model, const SoOptions& options)
    : model_(model),
      options_((options.validate(), options)),
      free_(model),
      state_(model),
      paths_(model),
      muscles_(makeMuscles(model.spec().muscles)),
      actuators_(model, free_, joinActuators(model.spec(), options)),
      problem_(free_.count(), model.muscleCount() + actuators_.count()),
      qp_(free_.count(), model.muscleCount() + actuators_.count(), {options.exponent}),
      q_(model.coordinateCount()),
      u_(model.coordinateCount()),
      u_dot_(model.coordinateCount()),
      tau_(model.coordinateCount()),
      tau_free_(free_.count()),
      path_speeds_(model.muscleCount()),
      moment_arms_(model.muscleCount(), free_.count()),
      actuator_columns_(free_.count(), actuators_.count()),
      gains_(problem_.columns()),
      passive_(Eigen::VectorXd::Zero(model.muscleCount())),
      slack_(free_.count()) {
  problem_.weight.setOnes();
  for (int m = 0; m < model.muscleCount(); ++m) {
    const MuscleSpec& spec = model.spec().muscles[static_cast<std::size_t>(m)];
    problem_.lower[m] = spec.min_control;
    problem_.upper[m] = spec.max_control;
  }
  for (int k = 0; k < actuators_.count(); ++k) {
    const ActuatorSpec& spec = actuators_.specs()[static_cast<std::size_t>(k)];
    problem_.lower[model.muscleCount() + k] = openBound(spec.min_control);
    problem_.upper[model.muscleCount() + k] = openBound(spec.max_control);
    gains_[model.muscleCount() + k] = spec.optimal_force;
  }
}

std::vector<std::string> SoSolver::actuatorNames() const {
  std::vector<std::string> names;
  for (const MuscleSpec& muscle : model_.spec().muscles) {
    names.push_back(muscle.name);
  }
  for (const ActuatorSpec& actuator : actuators_.specs()) {
    names.push_back(actuator.name);
  }
  return names;
}

QpReport SoSolver::solveInstant(const Instant& instant,
                                const ExternalLoads& loads,
                                Eigen::Ref<Eigen::VectorXd> activations) {
  calcDemand(instant, loads);
  problem_.c = tau_free_;
  calcMuscleColumns();
  calcActuatorColumns();
  QpReport report;
  if (options_.solver == SoOptions::Solver::kIpopt) {
    activations.setConstant(kIpoptStart);
    report = solveByIpopt(problem_, {options_.exponent}, activations);
  } else {
    report = qp_.solve(problem_, activations);
  }
  slack_ = problem_.c;
  slack_.noalias() -= problem_.A * activations;
  return report;
}

void SoSolver::calcDemand(const Instant& instant, const ExternalLoads& loads) {
  free_.expandPose(instant.q, q_);
  free_.expandRates(instant.u, u_);
  free_.expandRates(instant.u_dot, u_dot_);
  state_.setMotion(q_, u_);
  loads.calc(instant.time, wrenches_);
  state_.calcInverseDynamics(u_dot_, wrenches_, tau_);
  free_.reduceForces(tau_, tau_free_);
}

void SoSolver::calcMuscleColumns() {
  paths_.calc(state_);
  paths_.calcSpeeds(u_, path_speeds_);
  free_.reduceColumns(paths_.momentArms(), moment_arms_);
  for (int m = 0; m < model_.muscleCount(); ++m) {
    const Muscle& muscle = muscles_[static_cast<std::size_t>(m)];
    const double length = paths_.lengths()[m];
    gains_[m] = options_.capacity == SoOptions::Capacity::kIsometric
                    ? muscle.maxIsometricForce()
                    : muscle.calcRigidForceLine(length, path_speeds_[m]).gain;
    problem_.A.col(m) = gains_[m] * moment_arms_.row(m).transpose();
    if (options_.passive_force == SoOptions::PassiveForce::kOn) {
      const FiberState fiber = muscle.calcRigid(muscle.minimumActivation(), length, 0.0);
      passive_[m] = muscle.maxIsometricForce() * fiber.passive_multiplier * fiber.cos_pennation;
      problem_.c -= passive_[m] * moment_arms_.row(m).transpose();
    }
  }
}

void SoSolver::calcActuatorColumns() {
  actuators_.calcColumns(state_, actuator_columns_);
  for (int k = 0; k < actuators_.count(); ++k) {
    const int column = model_.muscleCount() + k;
    problem_.A.col(column) = gains_[column] * actuator_columns_.col(k);
  }
}

SoResult SoSolver::solve(const TimeSeries& coordinates,
                         const ExternalLoads& loads,
                         const Progress& progress) {
  const ReferenceMotion motion(model_, free_, coordinates);
  const std::vector<int> rows = findRows(motion.times(), options_);
  std::vector<double> time;
  for (const int row : rows) {
    time.push_back(motion.times()[static_cast<std::size_t>(row)]);
  }
  SoResult result = makeResult(std::move(time));
  Eigen::VectorXd q(free_.count());
  Eigen::VectorXd u(free_.count());
  Eigen::VectorXd u_dot(free_.count());
  Eigen::VectorXd activations(actuatorCount());
  qp_.resetWarmStart();
  for (int row = 0; row < result.activations.rowCount(); ++row) {
    reportProgress(progress, static_cast<double>(row) / result.activations.rowCount());
    const double t = result.activations.time[static_cast<std::size_t>(row)];
    motion.calcPose(t, q);
    motion.calcSpeed(t, u);
    motion.calcAcceleration(t, u_dot);
    const QpReport report = solveInstant({t, q, u, u_dot}, loads, activations);
    storeRow(row, activations, report, result);
  }
  summarize(result);
  return result;
}

SoResult SoSolver::makeResult(std::vector<double> time) const {
  SoResult result;
  result.muscle_count = model_.muscleCount();
  result.activations = makeTimeSeries("activations", actuatorNames(), time);
  result.activations.units.assign(result.activations.labels.size(), "");
  result.forces = makeTimeSeries("forces", actuatorNames(), time);
  result.forces.units.assign(static_cast<std::size_t>(model_.muscleCount()), "N");
  for (const ActuatorSpec& actuator : actuators_.specs()) {
    const bool is_force =
        actuator.kind == ActuatorSpec::Kind::kPoint ||
        (actuator.kind == ActuatorSpec::Kind::kCoordinate &&
         findMotionKind(model_.spec(), actuator.coordinate) == MotionKind::kTranslational);
    result.forces.units.emplace_back(is_force ? "N" : "N.m");
  }
  std::vector<std::string> names;
  std::vector<std::string> units;
  for (const CoordinateIndex c : free_.indices()) {
    names.push_back(model_.coordinate(c).name);
    units.emplace_back(model_.motionKind(c) == MotionKind::kTranslational ? "N" : "N.m");
  }
  result.demand = makeTimeSeries("demand", std::move(names), time);
  result.demand.units = std::move(units);
  result.pose = makeMotionTable(model_, "pose", "", time);
  result.speed = makeMotionTable(model_, "speed", "/s", std::move(time));
  result.iterations.assign(static_cast<std::size_t>(result.activations.rowCount()), 0);
  return result;
}

void SoSolver::storeRow(int row,
                        const Eigen::VectorXd& activations,
                        const QpReport& report,
                        SoResult& result) const {
  result.activations.values.row(row) = activations.transpose();
  result.forces.values.row(row) = activations.cwiseProduct(gains_).transpose();
  result.forces.values.row(row).head(model_.muscleCount()) += passive_.transpose();
  result.demand.values.row(row) = tau_free_.transpose();
  result.pose.values.row(row) = q_.transpose();
  result.speed.values.row(row) = u_.transpose();
  result.iterations[static_cast<std::size_t>(row)] = report.iterations;
  Eigen::Index worst = 0;
  if (slack_.cwiseAbs().maxCoeff(&worst) > options_.infeasible_above) {
    result.infeasible_rows.push_back({result.activations.time[static_cast<std::size_t>(row)],
                                      result.demand.labels[static_cast<std::size_t>(worst)],
                                      slack_[worst]});
  }
}

void SoSolver::summarize(SoResult& result) const {
  for (int k = 0; k < actuators_.count(); ++k) {
    const auto column = result.forces.values.col(model_.muscleCount() + k);
    result.peak_actuator_forces.push_back(column.cwiseAbs().maxCoeff());
  }
  if (!result.infeasible_rows.empty()) {
    const auto worst = std::max_element(
        result.infeasible_rows.begin(),
        result.infeasible_rows.end(),
        [](const auto& a, const auto& b) { return std::abs(a.missing) < std::abs(b.missing); });
    result.warnings.push_back(std::to_string(result.infeasible_rows.size()) +
                              " rows ask for more than the actuators can give; most at " +
                              worst->coordinate + ", t = " + std::to_string(worst->time) +
                              " s, where " + std::to_string(worst->missing) + " are missing");
  }
}

}  // namespace gaitmill

#include "core/rra/rra_simulation.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/where.h"
#include "core/model/free_coordinates.h"
#include "core/model/model.h"
#include "core/rra/actuated_body.h"
#include "core/rra/motion_integrator.h"
#include "core/rra/residual_statistics.h"
#include "core/rra/tracking_controller.h"

namespace gaitmill {
namespace {

// Length of the initial window, whose controls hold at the start itself.
constexpr double kInitialWindow = 1e-8;  // [s]

std::string findUnit(const Model& model, CoordinateIndex c) {
  return model.motionKind(c) == MotionKind::kTranslational ? "m" : "rad";
}

// One forward simulation: model, controller and integrator of a pass, and the tables they fill.
class Simulation {
 public:
  Simulation(const ModelSpec& spec,
             const ReferenceMotion& reference,
             const ExternalLoads& loads,
             const RraOptions& options,
             const RraPassOptions& pass)
      : options_(options),
        pass_(pass),
        model_(spec),
        free_(model_),
        body_(model_, free_, loads, options.actuators),
        controller_(model_, reference, body_, pass.tasks),
        integrator_(body_, options.integration_tolerance),
        reference_(reference) {}

  void run(const Progress& progress, RraPassResult& result);

 private:
  int countWindows() const;
  void makeTables(int rows, RraPassResult& result) const;
  void setStart();
  void record(int row, const Eigen::VectorXd& controls, RraPassResult& result);

  const RraOptions& options_;
  const RraPassOptions& pass_;
  Model model_;
  FreeCoordinates free_;
  ActuatedBody body_;
  TrackingController controller_;
  MotionIntegrator integrator_;
  const ReferenceMotion& reference_;
  MotionState state_;
};

// The last window ends one window before the end of the range.
int Simulation::countWindows() const {
  const double windows = (pass_.end_time - pass_.start_time) / options_.window;
  const int count = static_cast<int>(std::floor(windows + 1e-6)) - 1;
  require(count >= 1,
          ErrorCode::kInputTimeRange,
          "the time range of a pass is shorter than two control windows",
          atTime(pass_.start_time));
  return count;
}

void Simulation::setStart() {
  state_.time = pass_.start_time;
  state_.q.resize(free_.count());
  state_.u.resize(free_.count());
  reference_.calcPose(state_.time, state_.q);
  reference_.calcSpeed(state_.time, state_.u);
}

void Simulation::run(const Progress& progress, RraPassResult& result) {
  const int windows = countWindows();
  makeTables(windows + 1, result);
  setStart();

  MotionIntegrator::Ramp ramp;
  ramp.from.resize(body_.actuators().count());
  ramp.to.resize(body_.actuators().count());
  ramp.to_time = state_.time + kInitialWindow;
  controller_.solve(state_, ramp.to_time, ramp.to);
  record(0, ramp.to, result);
  for (int window = 0; window < windows; ++window) {
    reportProgress(progress, static_cast<double>(window) / windows);
    std::swap(ramp.from, ramp.to);
    ramp.from_time = ramp.to_time;
    ramp.to_time = pass_.start_time + (window + 1) * options_.window;
    if (controller_.solve(state_, ramp.to_time, ramp.to)) ++result.counters.bounded_windows;
    const MotionIntegrator::Work work = integrator_.advance(ramp, ramp.to_time, state_);
    result.counters.steps += work.steps;
    result.counters.rejected_steps += work.rejected;
    ++result.counters.windows;
    require(state_.q.allFinite(),
            ErrorCode::kInputValue,
            "the tracking simulation diverged",
            atTime(state_.time));
    record(window + 1, ramp.to, result);
  }
  reportProgress(progress, 1.0);
  result.residuals = calcResidualStatistics(result.residual_sums);
  result.tracking = calcTrackingStatistics(result.tracking_errors);
}

void Simulation::makeTables(int rows, RraPassResult& result) const {
  std::vector<double> time(static_cast<std::size_t>(rows));
  for (int i = 0; i < rows; ++i) {
    time[static_cast<std::size_t>(i)] = pass_.start_time + i * options_.window;
  }
  result.coordinates = makeTimeSeries("Coordinates", model_.coordinateNames(), time);
  result.speeds = makeTimeSeries("Speeds", model_.coordinateNames(), time);
  for (int c = 0; c < model_.coordinateCount(); ++c) {
    const std::string unit = findUnit(model_, CoordinateIndex(c));
    result.coordinates.units.push_back(unit);
    result.speeds.units.push_back(unit + "/s");
  }
  std::vector<std::string> tracked;
  std::vector<std::string> units;
  for (const CoordinateIndex c : free_.indices()) {
    tracked.push_back(model_.coordinateNames()[static_cast<std::size_t>(c.value())]);
    units.push_back(findUnit(model_, c));
  }
  result.tracking_errors = makeTimeSeries("Tracking errors", tracked, time);
  result.tracking_errors.units = units;
  std::vector<std::string> names;
  units.clear();
  for (const ActuatorSpec& actuator : body_.actuators().specs()) {
    const bool force = actuator.kind == ActuatorSpec::Kind::kPoint ||
                       (actuator.kind == ActuatorSpec::Kind::kCoordinate &&
                        findUnit(model_, model_.getCoordinate(actuator.coordinate)) == "m");
    names.push_back(actuator.name);
    units.push_back(force ? "N" : "N.m");
  }
  result.actuator_forces = makeTimeSeries("Actuator forces", names, time);
  result.actuator_forces.units = units;
  result.residual_sums = makeResidualTable(time);
}

void Simulation::record(int row, const Eigen::VectorXd& controls, RraPassResult& result) {
  body_.setMotion(state_.time, state_.q, state_.u);
  const Eigen::VectorXd force = controls.cwiseProduct(body_.actuators().optimalForces());
  result.coordinates.values.row(row) = body_.q().transpose();
  result.speeds.values.row(row) = body_.u().transpose();
  result.actuator_forces.values.row(row) = force.transpose();
  setResidualRow(body_.sumResiduals(force), row, result.residual_sums);
  Eigen::VectorXd desired(free_.count());
  reference_.calcPose(state_.time, desired);
  result.tracking_errors.values.row(row) = (desired - state_.q).transpose();
}

}  // namespace

void simulatePass(const ModelSpec& model,
                  const ReferenceMotion& reference,
                  const ExternalLoads& loads,
                  const RraOptions& options,
                  const Progress& progress,
                  RraPassResult& result) {
  const RraPassOptions pass = result.used;
  Simulation(model, reference, loads, options, pass).run(progress, result);
}

}  // namespace gaitmill

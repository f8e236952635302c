#include "core/cmc/cmc_solver.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/cmc/cmc_controller.h"
#include "core/cmc/cmc_recorder.h"
#include "core/cmc/cmc_state.h"
#include "core/cmc/forward_integrator.h"
#include "core/cmc/musculoskeleton.h"
#include "core/model/free_coordinates.h"
#include "core/muscle/muscle.h"

namespace gaitmill {
namespace {

// Sums of 10 ms steps miss the end time by round-off [s].
constexpr double kTimeRoundOff = 1e-9;
// Nothing that moves like a body has speeds beyond this [rad/s|m/s].
constexpr double kRunawaySpeed = 1e3;

// The model's own torque actuators, then residuals and reserves.
std::vector<ActuatorSpec> listActuators(const Model& model, const CmcOptions& options) {
  std::vector<ActuatorSpec> actuators = model.spec().actuators;
  for (ActuatorSpec& actuator : actuators) {
    actuator.min_control = -options.torque_control_limit;
    actuator.max_control = options.torque_control_limit;
  }
  actuators.insert(actuators.end(), options.actuators.begin(), options.actuators.end());
  return actuators;
}

class CmcRun {
 public:
  CmcRun(const Model& model,
         const ReferenceMotion& reference,
         const ExternalLoads& loads,
         const CmcOptions& options)
      : options_(options),
        model_(model),
        reference_(reference),
        free_(model),
        muscles_(makeMuscles(model.spec().muscles)),
        body_(model, free_, loads, listActuators(model, options)),
        controller_(model.spec(), muscles_, reference, body_, options_),
        integrator_(muscles_, body_),
        steps_per_window_(countSteps(options)),
        recorder_(model, muscles_, body_, countWindows() * steps_per_window_ + 1, countWindows()) {
    const int m = body_.muscleCount();
    state_.q.setZero(free_.count());
    state_.u.setZero(free_.count());
    state_.activation.setZero(m);
    state_.fiber_length.setZero(m);
    controls_.excitation.setZero(m);
    controls_.actuator_force.setZero(body_.actuators().count());
    actuators_before_ = controls_.actuator_force;
  }

  CmcResult solve(const Progress& progress) {
    initializeMuscles();
    solveInitialStage(progress);
    const CmcStop stop = simulate(progress);
    CmcResult result = recorder_.take();
    result.stop = stop;
    result.counters = counters_;
    result.counters.predictions = controller_.predictor().predictions();
    result.counters.fiber_steps = controller_.predictor().fiberSteps();
    result.counters.rejected_steps = controller_.predictor().rejectedSteps();
    result.counters.path_evaluations = body_.pathEvaluations();
    result.options = options_;
    return result;
  }

 private:
  static int countSteps(const CmcOptions& options) {
    return static_cast<int>(std::ceil(options.window / options.integration_step - kTimeRoundOff));
  }

  double finalTime() const { return options_.end_time - options_.window; }

  // The last window may be cut short by the end.
  int countWindows() const {
    const double span = finalTime() - options_.start_time - options_.initial_window;
    return static_cast<int>(std::ceil(span / options_.window - kTimeRoundOff));
  }

  // Default activations, and fibers at rest at the default pose or at their default lengths.
  void initializeMuscles() {
    free_.pick(model_.defaultPose(), state_.q);
    body_.setMotion(state_.q, state_.u);
    for (std::size_t m = 0; m < muscles_.size(); ++m) {
      const MuscleSpec& spec = model_.spec().muscles[m];
      const auto i = static_cast<Eigen::Index>(m);
      state_.activation[i] = std::max(spec.default_activation, spec.minimum_activation);
      state_.fiber_length[i] =
          options_.equilibrate_at_default_pose && !muscles_[m].hasRigidTendon()
              ? muscles_[m].solveStaticLength(state_.activation[i], body_.pathLengths()[i])
              : spec.default_fiber_length;
    }
  }

  // Two passes of settling and solving, so that the simulation starts near its steady motion
  // (spec/cmc.md 2).
  void solveInitialStage(const Progress& progress) {
    placeOnReference(options_.start_time);
    recorder_.addTrackingError(state_.time, Eigen::VectorXd::Zero(free_.count()));
    controls_.excitation.setConstant(options_.hold_excitation);
    // Five steps of equal cost before the first window: each may be the last one wanted.
    const auto hold = [&] {
      reportProgress(progress, 0.0);
      controller_.hold(state_, options_.hold_duration, controls_.excitation);
    };
    const auto solve_initial_window = [&] {
      reportProgress(progress, 0.0);
      solveWindow(options_.initial_window);
    };
    hold();
    hold();
    solve_initial_window();
    hold();
    solve_initial_window();
    controller_.followPrediction(state_, controls_.excitation);
    placeOnReference(options_.start_time + options_.initial_window);
  }

  void placeOnReference(double t) {
    state_.time = t;
    reference_.calcPose(t, state_.q);
    reference_.calcSpeed(t, state_.u);
  }

  void solveWindow(double duration) {
    controller_.solve(state_, duration, controls_);
    counters_.qp_iterations += controller_.window().qp.iterations;
  }

  bool isRunaway() const { return !(state_.u.cwiseAbs().maxCoeff() < kRunawaySpeed); }

  CmcStop simulate(const Progress& progress) {
    const int windows = countWindows();
    for (int w = 0; w < windows; ++w) {
      reportProgress(progress, static_cast<double>(w) / windows);
      const double start = state_.time;
      excitation_before_ = controls_.excitation;
      actuators_before_ = controls_.actuator_force;
      solveWindow(options_.window);
      ++counters_.windows;
      recorder_.addTrackingError(start, controller_.window().position_error);
      if (controller_.window().qp.stop != QpStop::kSolved) {
        recorder_.addInfeasible(controller_.window());
      }
      integrateWindow(start);
      if (isRunaway()) {
        return CmcStop::kDiverged;
      }
    }
    integrator_.evaluate(state_);
    recorder_.addRow(state_, controls_.excitation, integrator_, body_);
    reportProgress(progress, 1);
    return CmcStop::kFinished;
  }

  // Rows stand at the beginning of steps, where everything is evaluated anyway; the first of them
  // still belongs to the excitation of the interval that ends there.
  void integrateWindow(double start) {
    integrator_.startWindow(
        start, options_.window, controls_.excitation, actuators_before_, controls_.actuator_force);
    const double end = std::min(start + options_.window, finalTime());
    const double step = (end - start) / steps_per_window_;
    for (int s = 0; s < steps_per_window_; ++s) {
      integrator_.evaluate(state_);
      recorder_.addRow(
          state_, s == 0 ? excitation_before_ : controls_.excitation, integrator_, body_);
      integrator_.advance(state_, step);
    }
    // The published run accumulates window times like this; its limits depend on the last bit.
    state_.time = end;
  }

  CmcOptions options_;
  const Model& model_;
  const ReferenceMotion& reference_;
  FreeCoordinates free_;
  std::vector<Muscle> muscles_;
  Musculoskeleton body_;
  CmcController controller_;
  ForwardIntegrator integrator_;
  int steps_per_window_;
  CmcRecorder recorder_;
  CmcState state_;
  CmcControls controls_;
  Eigen::VectorXd excitation_before_;
  Eigen::VectorXd actuators_before_;
  CmcCounters counters_;
};

}  // namespace

CmcResult solveCmc(const Model& model,
                   const ReferenceMotion& reference,
                   const ExternalLoads& loads,
                   const CmcOptions& options,
                   const Progress& progress) {
  options.validate();
  return CmcRun(model, reference, loads, options).solve(progress);
}

}  // namespace gaitmill

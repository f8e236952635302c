#include "core/cmc/cmc_controller.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/math/ipopt_qp.h"

namespace gaitmill {
namespace {

// Pieces of the path table are about this long [s] (spec/cmc.md 6a).
constexpr double kPathInterval = 0.005;
// Weight of a muscle that can do nothing: as if its active force were 1e-6 F0M (spec/cmc.md 3.6).
constexpr double kLeastActiveForce = 1e-6;

int countIntervals(double duration) {
  return std::max(1, static_cast<int>(std::lround(duration / kPathInterval)));
}

DiagonalQpOptions makeQpOptions(const CmcOptions& options) {
  DiagonalQpOptions qp;
  qp.barrier = options.barrier;
  return qp;
}

int countMaxIntervals(const CmcOptions& options) {
  return countIntervals(std::max(options.window, options.initial_window));
}

}  // namespace

CmcController::CmcController(const ModelSpec& model,
                             const std::vector<Muscle>& muscles,
                             const ReferenceMotion& reference,
                             Musculoskeleton& body,
                             const CmcOptions& options)
    : muscles_(muscles),
      reference_(reference),
      body_(body),
      options_(options),
      limits_(model, options),
      predictor_(muscles, countMaxIntervals(options), options.fiber_tolerance),
      problem_(body.free().count(), body.muscleCount() + body.actuators().count()),
      qp_(problem_.rows(), problem_.columns(), makeQpOptions(options)) {
  const int f = problem_.rows();
  const int m = body.muscleCount();
  for (Eigen::VectorXd* v : {&window_.position_error,
                             &window_.speed_error,
                             &window_.wanted_acceleration,
                             &window_.slack,
                             &q_offset_,
                             &u_offset_,
                             &q_,
                             &q_dot_,
                             &u_}) {
    v->setZero(f);
  }
  window_.ranges.resize(static_cast<std::size_t>(m));
  window_.rigid_active_force.setZero(m);
  window_.force.setZero(problem_.columns());
  full_rates_.setZero(body.speed().size());
  path_slopes_.setZero(m);

  // What the actuators cost and can do does not change.
  const IdealActuators& actuators = body.actuators();
  const int k = actuators.count();
  problem_.weight.tail(k) = actuators.optimalForces().array().square().inverse();
  problem_.lower.tail(k) = actuators.minForces();
  problem_.upper.tail(k) = actuators.maxForces();
}

void CmcController::solve(const CmcState& state, double duration, CmcControls& controls) {
  calcErrors(state, duration);
  predictPaths(state, duration);
  calcRanges(state);
  fillProblem(state.time + duration);
  shareForces();
  for (std::size_t m = 0; m < muscles_.size(); ++m) {
    const auto i = static_cast<Eigen::Index>(m);
    controls.excitation[i] = predictor_.findExcitation(static_cast<int>(m),
                                                       {state.activation[i], state.fiber_length[i]},
                                                       window_.ranges[m],
                                                       window_.force[i],
                                                       options_.excitation_tolerance);
  }
  controls.actuator_force = window_.force.tail(controls.actuator_force.size());
}

// a* = udot_ref(t + duration) + k_v (u_ref(t) - u) + k_p (q_ref(t) - q): errors of now,
// feed-forward of the end. The constant corrections use the derivative of q_ref instead of u_ref.
void CmcController::calcErrors(const CmcState& state, double duration) {
  window_.time = state.time;
  reference_.calcPose(state.time, q_, q_dot_);
  reference_.calcSpeed(state.time, u_);
  q_offset_ = state.q - q_;
  u_offset_ = state.u - q_dot_;
  window_.position_error = q_ - state.q;
  window_.speed_error = u_ - state.u;
  reference_.calcAcceleration(state.time + duration, window_.wanted_acceleration);
  window_.wanted_acceleration += options_.velocity_gain * window_.speed_error +
                                 options_.position_gain * window_.position_error;
}

void CmcController::predictPaths(const CmcState& state, double duration) {
  const int intervals = countIntervals(duration);
  predictor_.paths().start(duration / intervals, intervals);
  for (int k = 0; k <= intervals; ++k) {
    reference_.calcPose(state.time + duration * k / intervals, q_, q_dot_);
    u_ = q_dot_ + u_offset_;
    q_ += q_offset_;
    body_.setMotion(q_, u_);
    // The prescribed speed is not the derivative of the prescribed pose: the offset makes the
    // difference, and only lengths count between the nodes.
    body_.free().expandRates(q_dot_, full_rates_);
    body_.calcPathSpeeds(full_rates_, path_slopes_);
    predictor_.paths().setNode(k, body_.pathLengths(), path_slopes_);
  }
  predictor_.setEnd(duration, body_.pathLengths(), body_.pathSpeeds());
}

void CmcController::calcRanges(const CmcState& state) {
  for (std::size_t m = 0; m < muscles_.size(); ++m) {
    const int muscle = static_cast<int>(m);
    const MusclePredictor::Start start = {state.activation[muscle], state.fiber_length[muscle]};
    MusclePredictor::Range& range = window_.ranges[m];
    range.max_excitation = limits_.findUpper(muscle, state.time);
    range.min_excitation = std::min(options_.min_excitation, range.max_excitation);
    range.min_force = predictor_.predict(muscle, start, range.min_excitation).tendon_force;
    range.max_force = range.max_excitation > range.min_excitation
                          ? predictor_.predict(muscle, start, range.max_excitation).tendon_force
                          : range.min_force;
    if (range.max_force - range.min_force < options_.uncontrollable_range) {
      range.max_excitation = range.min_excitation;
      range.max_force = range.min_force;
    }
  }
}

// arms^T F_muscle + columns F_actuator = M a* + bias, in N.m: the same forces as the rows in
// accelerations would give, without inverting M.
void CmcController::fillProblem(double end_time) {
  body_.calcDynamics(end_time);
  const int m = body_.muscleCount();
  problem_.A.leftCols(m) = body_.momentArms().transpose();
  problem_.A.rightCols(problem_.columns() - m) = body_.actuatorColumns();
  problem_.c.noalias() = body_.massMatrix() * window_.wanted_acceleration;
  problem_.c += body_.bias();
  for (int i = 0; i < m; ++i) {
    const auto s = static_cast<std::size_t>(i);
    window_.rigid_active_force[i] = predictor_.rigidActiveForce(i);
    const double scale = std::max(std::abs(window_.rigid_active_force[i]),
                                  kLeastActiveForce * muscles_[s].maxIsometricForce());
    problem_.weight[i] = 1 / (scale * scale);
    problem_.lower[i] = window_.ranges[s].min_force;
    problem_.upper[i] = window_.ranges[s].max_force;
  }
}

void CmcController::shareForces() {
  if (options_.qp_solver == CmcQpSolver::kIpopt) {
    window_.qp = solveByIpopt(problem_, IpoptQpOptions{}, window_.force);
    window_.slack = problem_.c - problem_.A * window_.force;
    if (window_.qp.stop == QpStop::kSolved) {
      return;
    }
  }
  window_.qp = qp_.solve(problem_, window_.force);
  window_.slack = qp_.slack();
}

void CmcController::hold(CmcState& state, double duration, const Eigen::VectorXd& excitation) {
  body_.setMotion(state.q, state.u);
  predictor_.paths().start(duration, 1);
  path_slopes_.setZero();
  predictor_.paths().setNode(0, body_.pathLengths(), path_slopes_);
  predictor_.paths().setNode(1, body_.pathLengths(), path_slopes_);
  predictor_.setEnd(duration, body_.pathLengths(), body_.pathSpeeds());
  followPrediction(state, excitation);
}

void CmcController::followPrediction(CmcState& state, const Eigen::VectorXd& excitation) {
  for (std::size_t m = 0; m < muscles_.size(); ++m) {
    const auto i = static_cast<Eigen::Index>(m);
    const MusclePrediction end = predictor_.predict(
        static_cast<int>(m), {state.activation[i], state.fiber_length[i]}, excitation[i]);
    state.activation[i] = end.activation;
    state.fiber_length[i] = end.fiber_length;
  }
}

}  // namespace gaitmill

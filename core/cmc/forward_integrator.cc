#include "core/cmc/forward_integrator.h"

#include <algorithm>
#include <cmath>

namespace gaitmill {

ForwardIntegrator::ForwardIntegrator(const std::vector<Muscle>& muscles, Musculoskeleton& body)
    : muscles_(muscles), body_(body) {
  const int f = body.free().count();
  const int m = body.muscleCount();
  const int k = body.actuators().count();
  for (Eigen::VectorXd* v : {&excitation_, &tendon_force_, &fiber_start_}) {
    v->setZero(m);
  }
  for (Eigen::VectorXd* v : {&actuators_from_, &actuators_to_, &actuator_force_}) {
    v->setZero(k);
  }
  q_.setZero(f);
  u_.setZero(f);
  for (std::size_t i = 0; i < ark::kStages; ++i) {
    u_rates_[i].setZero(f);
    u_dot_[i].setZero(f);
    fiber_rates_[i].setZero(m);
  }
}

void ForwardIntegrator::startWindow(double start_time,
                                    double duration,
                                    const Eigen::VectorXd& excitation,
                                    const Eigen::VectorXd& actuators_from,
                                    const Eigen::VectorXd& actuators_to) {
  start_time_ = start_time;
  duration_ = duration;
  excitation_ = excitation;
  actuators_from_ = actuators_from;
  actuators_to_ = actuators_to;
}

void ForwardIntegrator::calcActuatorForces(double t) {
  const double fraction = std::clamp((t - start_time_) / duration_, 0.0, 1.0);
  actuator_force_ = actuators_from_ + fraction * (actuators_to_ - actuators_from_);
}

// Tendon forces and fiber velocities at the body's present paths. The fiber of a stage ends at
// fiber_start + implicit * velocity.
void ForwardIntegrator::calcMuscleForces(std::size_t stage,
                                         const StageMuscles& at,
                                         const CmcState& state) {
  for (std::size_t m = 0; m < muscles_.size(); ++m) {
    const Muscle& muscle = muscles_[m];
    const auto i = static_cast<Eigen::Index>(m);
    const double a =
        muscle.activationDynamics().propagate(state.activation[i], excitation_[i], at.since_start);
    const double path_length = body_.pathLengths()[i];
    if (muscle.hasRigidTendon()) {
      const Muscle::ForceLine line = muscle.calcRigidForceLine(path_length, body_.pathSpeeds()[i]);
      tendon_force_[i] = std::max(0.0, line.gain * a + line.offset);
      continue;
    }
    const std::size_t before = stage == 0 ? ark::kStages - 1 : stage - 1;
    double velocity = muscle.solveStageVelocity({a, fiber_start_[i], path_length, at.implicit},
                                                fiber_rates_[before][i]);
    if (fiber_start_[i] <= muscle.minFiberLength()) {
      velocity = std::max(velocity, 0.0);
    }
    fiber_rates_[stage][i] = velocity;
    tendon_force_[i] =
        muscle.calcTendonForce(fiber_start_[i] + at.implicit * velocity, path_length);
  }
}

void ForwardIntegrator::evaluate(const CmcState& state) {
  body_.setMotion(state.q, state.u);
  body_.calcDynamics(state.time);
  fiber_start_ = state.fiber_length;
  calcMuscleForces(0, {state.time, 0, 0}, state);
  calcActuatorForces(state.time);
  u_rates_[0] = state.u;
  body_.solveAcceleration(tendon_force_, actuator_force_, u_dot_[0]);
}

void ForwardIntegrator::advance(CmcState& state, double step) {
  for (std::size_t i = 1; i < ark::kStages; ++i) {
    q_ = state.q;
    u_ = state.u;
    fiber_start_ = state.fiber_length;
    for (std::size_t j = 0; j < i; ++j) {
      q_ += step * ark::kExplicit[i][j] * u_rates_[j];
      u_ += step * ark::kExplicit[i][j] * u_dot_[j];
      fiber_start_ += step * ark::kImplicit[i][j] * fiber_rates_[j];
    }
    const double since_start = step * ark::kNodes[i];
    const double t = state.time + since_start;
    body_.setMotion(q_, u_);
    body_.calcDynamics(t);
    calcMuscleForces(i, {t, since_start, step * ark::kGamma}, state);
    calcActuatorForces(t);
    u_rates_[i] = u_;
    body_.solveAcceleration(tendon_force_, actuator_force_, u_dot_[i]);
  }

  // Weights of order 4; their difference to those of order 3 estimates the error.
  q_.setZero();
  u_.setZero();
  for (std::size_t i = 0; i < ark::kStages; ++i) {
    state.q += step * ark::kWeights[i] * u_rates_[i];
    state.u += step * ark::kWeights[i] * u_dot_[i];
    state.fiber_length += step * ark::kWeights[i] * fiber_rates_[i];
    u_ += step * (ark::kWeights[i] - ark::kEmbedded[i]) * u_dot_[i];
  }
  error_.speed = u_.size() > 0 ? u_.cwiseAbs().maxCoeff() : 0;
  error_.fiber = 0;
  for (std::size_t m = 0; m < muscles_.size(); ++m) {
    const auto i = static_cast<Eigen::Index>(m);
    const Muscle& muscle = muscles_[m];
    state.activation[i] =
        muscle.activationDynamics().propagate(state.activation[i], excitation_[i], step);
    if (muscle.hasRigidTendon()) {
      continue;
    }
    state.fiber_length[i] = std::max(state.fiber_length[i], muscle.minFiberLength());
    double error = 0;
    for (std::size_t s = 0; s < ark::kStages; ++s) {
      error += step * (ark::kWeights[s] - ark::kEmbedded[s]) * fiber_rates_[s][i];
    }
    error_.fiber = std::max(error_.fiber, std::abs(error) / muscle.optimalFiberLength());
  }
  state.time += step;
}

}  // namespace gaitmill

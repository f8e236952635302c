#include "core/rra/motion_integrator.h"

#include <algorithm>
#include <cmath>

namespace gaitmill {
namespace {

// Coefficients of Merson (1957): stage times and the weights of earlier rates.
constexpr std::array<double, 5> kTimes = {0, 1.0 / 3, 1.0 / 3, 1.0 / 2, 1};
constexpr std::array<std::array<double, 4>, 5> kWeights = {{{0, 0, 0, 0},
                                                            {1.0 / 3, 0, 0, 0},
                                                            {1.0 / 6, 1.0 / 6, 0, 0},
                                                            {1.0 / 8, 0, 3.0 / 8, 0},
                                                            {1.0 / 2, 0, -3.0 / 2, 2}}};
// Fourth-order result, and its difference from the fifth stage's third-order one.
constexpr std::array<double, 5> kResult = {1.0 / 6, 0, 0, 2.0 / 3, 1.0 / 6};
constexpr std::array<double, 5> kError = {1.0 / 15, 0, -3.0 / 10, 4.0 / 15, -1.0 / 30};

// A speed error acts on coordinates for about the time constant of the closed loop's tenth.
constexpr double kSpeedHorizon = 0.01;  // [s]
// Halvings of a window that are tried before a step is taken as it is.
constexpr int kMaxHalvings = 7;

}  // namespace

MotionIntegrator::MotionIntegrator(ActuatedBody& body, double tolerance)
    : body_(body), tolerance_(tolerance) {
  const int n = body.free().count();
  q_.setZero(n);
  u_.setZero(n);
  force_.setZero(body.actuators().count());
  for (Eigen::VectorXd& rate : q_rate_) rate.setZero(n);
  for (Eigen::VectorXd& rate : u_rate_) rate.setZero(n);
}

MotionIntegrator::Work MotionIntegrator::advance(const Ramp& ramp,
                                                 double end_time,
                                                 MotionState& state) {
  Work work;
  const double smallest = std::ldexp(end_time - state.time, -kMaxHalvings);
  double step = end_time - state.time;
  while (state.time < end_time) {
    const bool last = step >= end_time - state.time;
    if (last) step = end_time - state.time;
    if (calcStep(ramp, step, state) > tolerance_ && step > smallest) {
      step *= 0.5;
      ++work.rejected;
      continue;
    }
    state.q = q_;
    state.u = u_;
    state.time = last ? end_time : state.time + step;
    ++work.steps;
    step *= 2;
  }
  return work;
}

// Leaves the step's end in q_ and u_; returns the error estimate.
double MotionIntegrator::calcStep(const Ramp& ramp, double step, const MotionState& state) {
  for (int stage = 0; stage < kStages; ++stage) {
    const auto s = static_cast<std::size_t>(stage);
    q_ = state.q;
    u_ = state.u;
    for (std::size_t k = 0; k < s; ++k) {
      const double weight = step * kWeights[s][k];
      if (weight == 0) continue;
      q_ += weight * q_rate_[k];
      u_ += weight * u_rate_[k];
    }
    calcRates(ramp, state.time + kTimes[s] * step, stage);
  }
  q_ = state.q;
  u_ = state.u;
  for (std::size_t k = 0; k < kResult.size(); ++k) {
    q_ += step * kResult[k] * q_rate_[k];
    u_ += step * kResult[k] * u_rate_[k];
  }
  double error = 0;
  for (Eigen::Index i = 0; i < q_.size(); ++i) {
    double q_error = 0;
    double u_error = 0;
    for (std::size_t k = 0; k < kError.size(); ++k) {
      q_error += kError[k] * q_rate_[k](i);
      u_error += kError[k] * u_rate_[k](i);
    }
    error = std::max({error, std::abs(step * q_error), std::abs(step * u_error) * kSpeedHorizon});
  }
  return error;
}

void MotionIntegrator::calcRates(const Ramp& ramp, double t, int stage) {
  const double fraction =
      std::clamp((t - ramp.from_time) / (ramp.to_time - ramp.from_time), 0.0, 1.0);
  force_ = (ramp.from + fraction * (ramp.to - ramp.from))
               .cwiseProduct(body_.actuators().optimalForces());
  body_.setMotion(t, q_, u_);
  const auto s = static_cast<std::size_t>(stage);
  q_rate_[s] = u_;
  body_.calcAcceleration(force_, u_rate_[s]);
}

}  // namespace gaitmill

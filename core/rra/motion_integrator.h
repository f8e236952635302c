#pragma once

#include <array>

#include <Eigen/Core>

#include "core/rra/actuated_body.h"
#include "core/rra/tracking_controller.h"

namespace gaitmill {

/// Advances the bodies through one window under controls that ramp from node to node:
/// Runge-Kutta-Merson, fourth order with an error estimate from five stages. One step per window as
/// a rule; where a load jumps on or off the step is halved until the estimate is below the
/// tolerance. One per thread; advance() does not allocate.
class MotionIntegrator {
 public:
  /// Keeps a reference. @param tolerance  of coordinates, and of speeds times kSpeedHorizon
  MotionIntegrator(ActuatedBody& body, double tolerance);

  /// Linear controls: `from` at from_time, `to` at to_time, held outside.
  struct Ramp {
    double from_time = 0;
    double to_time = 0;
    Eigen::VectorXd from;  ///< (actuators)
    Eigen::VectorXd to;
  };

  struct Work {
    int steps = 0;
    int rejected = 0;
  };

  /// From state.time to `end_time`.
  Work advance(const Ramp& ramp, double end_time, MotionState& state);

 private:
  static constexpr int kStages = 5;

  double calcStep(const Ramp& ramp, double step, const MotionState& state);
  void calcRates(const Ramp& ramp, double t, int stage);

  ActuatedBody& body_;
  double tolerance_;
  Eigen::VectorXd q_, u_;  // (free) of a stage, then of the step's end
  Eigen::VectorXd force_;  // (actuators)
  std::array<Eigen::VectorXd, kStages> q_rate_, u_rate_;
};

}  // namespace gaitmill

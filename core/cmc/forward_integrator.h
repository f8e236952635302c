#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "core/cmc/additive_runge_kutta.h"
#include "core/cmc/cmc_state.h"
#include "core/cmc/musculoskeleton.h"
#include "core/muscle/muscle.h"

namespace gaitmill {

/// Advances the whole system, bodies and muscles, under given controls (spec/cmc.md 3.9) by
/// additive Runge-Kutta steps: coordinates and speeds explicitly, fibers of elastic tendons
/// implicitly at each stage's path length, activation in closed form. One per thread; members do
/// not allocate.
class ForwardIntegrator {
 public:
  /// Keeps references.
  ForwardIntegrator(const std::vector<Muscle>& muscles, Musculoskeleton& body);

  /// Controls of a window: excitations are constant, actuator forces ramp from `from` to `to`.
  void startWindow(double start_time,
                   double duration,
                   const Eigen::VectorXd& excitation,
                   const Eigen::VectorXd& actuators_from,
                   const Eigen::VectorXd& actuators_to);

  /// Forces and rates at `state`. Leaves the body's motion there.
  void evaluate(const CmcState& state);
  /// Advances by `step` [s] from the state last evaluated.
  void advance(CmcState& state, double step);

  // As last evaluated or at the last stage of a step.
  const Eigen::VectorXd& tendonForces() const { return tendon_force_; }      ///< (muscles) [N]
  const Eigen::VectorXd& actuatorForces() const { return actuator_force_; }  ///< [N|N.m]

  /// Estimated error of the last step: speeds [rad/s|m/s], fibers [l0M], the largest of each.
  struct StepError {
    double speed = 0;
    double fiber = 0;
  };
  const StepError& lastError() const { return error_; }

 private:
  struct StageMuscles {
    double time;
    double since_start;  ///< of the step [s]
    double implicit;     ///< step times the diagonal coefficient [s]; 0 in the first stage
  };
  void calcMuscleForces(std::size_t stage, const StageMuscles& at, const CmcState& state);
  void calcActuatorForces(double t);

  const std::vector<Muscle>& muscles_;
  Musculoskeleton& body_;
  double start_time_ = 0;
  double duration_ = 1;
  Eigen::VectorXd excitation_;
  Eigen::VectorXd actuators_from_, actuators_to_;
  Eigen::VectorXd tendon_force_, actuator_force_;
  Eigen::VectorXd fiber_start_;  // (muscles) explicit part of a stage's length
  Eigen::VectorXd q_, u_;
  std::array<Eigen::VectorXd, ark::kStages> u_rates_;      // dq/dt of the stages
  std::array<Eigen::VectorXd, ark::kStages> u_dot_;        // du/dt
  std::array<Eigen::VectorXd, ark::kStages> fiber_rates_;  // dl/dt
  StepError error_;
};

}  // namespace gaitmill

#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/math/bounded_least_squares.h"
#include "core/model/reference_motion.h"
#include "core/rra/actuated_body.h"
#include "core/rra/rra_options.h"

namespace gaitmill {

/// Pose and velocity of the free coordinates at one time.
struct MotionState {
  double time = 0;    ///< [s]
  Eigen::VectorXd q;  ///< (free) [rad|m]
  Eigen::VectorXd u;  ///< (free) per second
};

/// Finds the controls of one window (spec/rra.md 3): the accelerations that would bring the motion
/// back to the desired one,
///   a* = udot_ref(t + h) + k_v (u_ref(t) - u) + k_p (q_ref(t) - q),
/// traded against the effort of the actuators:
///   minimise  sum_j x_j^2 + sum_i w_i (a*_i - a_i)^2,   a = A F_opt x + b,   limits on x
/// with A and b in the pose predicted for t + h. One per thread; solve() does not allocate.
class TrackingController {
 public:
  /// Keeps references. @throws Error kInputCoordinates for tasks of unknown coordinates
  TrackingController(const Model& model,
                     const ReferenceMotion& reference,
                     ActuatedBody& body,
                     const std::vector<TrackingTask>& tasks);

  /// @param state     at t
  /// @param target    t + h [s]
  /// @param controls  out: x (actuators), F = F_opt x at the target time
  /// @returns whether some control ended on its limit
  bool solve(const MotionState& state, double target, Eigen::Ref<Eigen::VectorXd> controls);

  /// Of the last solve, (free): q_ref(t) - q, and a*.
  const Eigen::VectorXd& positionErrors() const { return position_error_; }
  const Eigen::VectorXd& wantedAccelerations() const { return wanted_; }

 private:
  void setWantedAccelerations(const MotionState& state, double target);
  void predictMotion(const MotionState& state, double target);

  const ReferenceMotion& reference_;
  ActuatedBody& body_;
  Eigen::VectorXd root_weight_, position_gain_, velocity_gain_;  // (free)
  Eigen::VectorXd lower_, upper_;                                // (actuators) controls
  Eigen::VectorXd position_error_, speed_error_, wanted_;        // (free)
  Eigen::VectorXd q_, u_, reference_q_, reference_u_;            // (free)
  Eigen::MatrixXd A_;                                            // (free x actuators)
  Eigen::VectorXd b_;                                            // (free)
  Eigen::MatrixXd C_;                                            // (actuators + free x actuators)
  Eigen::VectorXd d_;                                            // (actuators + free)
  BoundedLeastSquares least_squares_;
};

}  // namespace gaitmill

#include "core/rra/tracking_controller.h"

#include <cmath>

#include "core/base/error.h"

namespace gaitmill {

TrackingController::TrackingController(const Model& model,
                                       const ReferenceMotion& reference,
                                       ActuatedBody& body,
                                       const std::vector<TrackingTask>& tasks)
    : reference_(reference),
      body_(body),
      least_squares_(body.actuators().count() + body.free().count(), body.actuators().count()) {
  const int n = body.free().count();
  const int k = body.actuators().count();
  for (Eigen::VectorXd* v : {&root_weight_,
                             &position_gain_,
                             &velocity_gain_,
                             &position_error_,
                             &speed_error_,
                             &wanted_,
                             &q_,
                             &u_,
                             &reference_q_,
                             &reference_u_,
                             &b_}) {
    v->setZero(n);
  }
  for (const TrackingTask& task : tasks) {
    const int i = body.free().findFree(model.getCoordinate(task.coordinate));
    if (i < 0) continue;  // locked or driven by another coordinate: nothing to track
    root_weight_(i) = std::sqrt(task.weight);
    position_gain_(i) = task.position_gain;
    velocity_gain_(i) = task.velocity_gain;
  }
  lower_ = body.actuators().minForces().cwiseQuotient(body.actuators().optimalForces());
  upper_ = body.actuators().maxForces().cwiseQuotient(body.actuators().optimalForces());
  A_.setZero(n, k);
  C_.setZero(k + n, k);
  C_.topRows(k).setIdentity();
  d_.setZero(k + n);
}

bool TrackingController::solve(const MotionState& state,
                               double target,
                               Eigen::Ref<Eigen::VectorXd> controls) {
  setWantedAccelerations(state, target);
  predictMotion(state, target);
  body_.setMotion(target, q_, u_);
  body_.calcAffineAcceleration(A_, b_);

  // sqrt(w) (A F_opt x + b - a*) below the identity that measures the effort.
  const Eigen::Index k = A_.cols();
  for (Eigen::Index j = 0; j < k; ++j) {
    C_.col(j).tail(A_.rows()) =
        body_.actuators().optimalForces()(j) * root_weight_.cwiseProduct(A_.col(j));
  }
  d_.tail(A_.rows()) = root_weight_.cwiseProduct(wanted_ - b_);
  return least_squares_.solve(C_, d_, lower_, upper_, controls).active_bounds > 0;
}

void TrackingController::setWantedAccelerations(const MotionState& state, double target) {
  reference_.calcPose(state.time, reference_q_);
  reference_.calcSpeed(state.time, reference_u_);
  position_error_ = reference_q_ - state.q;
  speed_error_ = reference_u_ - state.u;
  reference_.calcAcceleration(target, wanted_);
  wanted_ +=
      velocity_gain_.cwiseProduct(speed_error_) + position_gain_.cwiseProduct(position_error_);
}

// The reference at the target, moved by the present deviation from the reference's own pose and
// slope (not u_ref: the two differ slightly).
void TrackingController::predictMotion(const MotionState& state, double target) {
  reference_.calcPose(state.time, reference_q_, reference_u_);
  reference_.calcPose(target, q_, u_);
  q_ += state.q - reference_q_;
  u_ += state.u - reference_u_;
}

}  // namespace gaitmill

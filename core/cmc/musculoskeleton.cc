#include "core/cmc/musculoskeleton.h"

#include <utility>

namespace gaitmill {

Musculoskeleton::Musculoskeleton(const Model& model,
                                 const FreeCoordinates& free,
                                 const ExternalLoads& loads,
                                 std::vector<ActuatorSpec> actuators)
    : free_(free),
      loads_(loads),
      actuators_(model, free, std::move(actuators)),
      state_(model),
      paths_(model),
      q_(model.defaultPose()),
      u_(Eigen::VectorXd::Zero(model.coordinateCount())),
      zero_(Eigen::VectorXd::Zero(model.coordinateCount())),
      tau_(model.coordinateCount()),
      full_mass_(model.coordinateCount(), model.coordinateCount()),
      path_speeds_(Eigen::VectorXd::Zero(model.muscleCount())),
      arms_(RowMatrix::Zero(model.muscleCount(), free.count())),
      mass_(free.count(), free.count()),
      bias_(free.count()),
      demand_(free.count()),
      columns_(free.count(), actuators_.count()),
      factor_(free.count()) {
  loads_.calc(0, wrenches_);  // sizes them
}

void Musculoskeleton::setMotion(const Eigen::Ref<const Eigen::VectorXd>& q,
                                const Eigen::Ref<const Eigen::VectorXd>& u) {
  free_.expandPose(q, q_);
  free_.expandRates(u, u_);
  state_.setMotion(q_, u_);
  paths_.calc(state_);
  paths_.calcSpeeds(u_, path_speeds_);
  free_.reduceColumns(paths_.momentArms(), arms_);
  ++path_evaluations_;
}

void Musculoskeleton::calcDynamics(double t) {
  loads_.calc(t, wrenches_);
  state_.calcMassMatrix(full_mass_);
  free_.reduceMassMatrix(full_mass_, mass_);
  // The dependent coordinates follow with constant slopes: no acceleration at udot_free = 0.
  state_.calcInverseDynamics(zero_, wrenches_, tau_);
  free_.reduceForces(tau_, bias_);
  actuators_.calcColumns(state_, columns_);
}

void Musculoskeleton::solveAcceleration(const Eigen::VectorXd& muscle_forces,
                                        const Eigen::VectorXd& actuator_forces,
                                        Eigen::Ref<Eigen::VectorXd> u_dot) {
  demand_ = -bias_;
  demand_.noalias() += arms_.transpose() * muscle_forces;
  demand_.noalias() += columns_ * actuator_forces;
  factor_.compute(mass_);
  u_dot = factor_.solve(demand_);
}

}  // namespace gaitmill

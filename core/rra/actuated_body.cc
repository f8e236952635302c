#include "core/rra/actuated_body.h"

#include <cstddef>
#include <utility>

namespace gaitmill {

ActuatedBody::ActuatedBody(const Model& model,
                           const FreeCoordinates& free,
                           const ExternalLoads& loads,
                           std::vector<ActuatorSpec> actuators)
    : free_(free),
      loads_(loads),
      actuators_(model, free, std::move(actuators)),
      state_(model),
      q_(model.coordinateCount()),
      u_(model.coordinateCount()),
      zero_(Eigen::VectorXd::Zero(model.coordinateCount())),
      tau_(model.coordinateCount()),
      full_mass_(model.coordinateCount(), model.coordinateCount()),
      mass_(free.count(), free.count()),
      bias_(free.count()),
      columns_(free.count(), actuators_.count()),
      factor_(free.count()) {
  for (const ActuatorSpec& spec : actuators_.specs()) {
    const bool on_body = spec.kind != ActuatorSpec::Kind::kCoordinate;
    actuator_bodies_.push_back(on_body ? model.getBody(spec.body) : kGround);
  }
}

void ActuatedBody::setMotion(double t,
                             const Eigen::Ref<const Eigen::VectorXd>& q,
                             const Eigen::Ref<const Eigen::VectorXd>& u) {
  free_.expandPose(q, q_);
  free_.expandRates(u, u_);
  state_.setMotion(q_, u_);
  loads_.calc(t, wrenches_);
  state_.calcInverseDynamics(zero_, wrenches_, tau_);
  free_.reduceForces(tau_, bias_);
  state_.calcMassMatrix(full_mass_);
  free_.reduceMassMatrix(full_mass_, mass_);
  factor_.compute(mass_);
  actuators_.calcColumns(state_, columns_);
}

void ActuatedBody::calcAcceleration(const Eigen::Ref<const Eigen::VectorXd>& F,
                                    Eigen::Ref<Eigen::VectorXd> udot) const {
  udot.noalias() = columns_ * F;
  udot -= bias_;
  factor_.solveInPlace(udot);
}

void ActuatedBody::calcAffineAcceleration(Eigen::Ref<Eigen::MatrixXd> A,
                                          Eigen::Ref<Eigen::VectorXd> b) const {
  A = columns_;
  factor_.solveInPlace(A);
  b = -bias_;
  factor_.solveInPlace(b);
}

void ActuatedBody::calcDemand(const Eigen::Ref<const Eigen::VectorXd>& udot,
                              Eigen::Ref<Eigen::VectorXd> demand) const {
  demand = bias_;
  demand.noalias() += mass_ * udot;
}

ResidualSum ActuatedBody::sumResiduals(const Eigen::Ref<const Eigen::VectorXd>& F) const {
  ResidualSum sum{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  for (std::size_t k = 0; k < actuator_bodies_.size(); ++k) {
    const ActuatorSpec& spec = actuators_.specs()[k];
    if (spec.kind == ActuatorSpec::Kind::kCoordinate) continue;
    const Eigen::Vector3d unit = spec.direction.normalized();
    const Eigen::Vector3d direction =
        spec.direction_in_ground ? unit
                                 : Eigen::Vector3d(state_.pose(actuator_bodies_[k]).R * unit);
    const double force = F(static_cast<Eigen::Index>(k));
    (spec.kind == ActuatorSpec::Kind::kPoint ? sum.force : sum.moment) += force * direction;
  }
  return sum;
}

}  // namespace gaitmill

#pragma once

#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "core/model/external_loads.h"
#include "core/model/free_coordinates.h"
#include "core/model/ideal_actuators.h"
#include "core/model/model.h"
#include "core/rra/rra_result.h"

namespace gaitmill {

/// Bodies moved by ideal actuators, in the free coordinates (couplers and locks eliminated):
///   M udot + bias = B F
/// Everything is evaluated at the motion last set. One per thread; members do not allocate.
class ActuatedBody {
 public:
  /// Keeps references to all but `actuators`.
  ActuatedBody(const Model& model,
               const FreeCoordinates& free,
               const ExternalLoads& loads,
               std::vector<ActuatorSpec> actuators);

  const FreeCoordinates& free() const { return free_; }
  const IdealActuators& actuators() const { return actuators_; }

  /// M (factored), bias with the ground reactions of time t, and B. @param q, u  (free)
  void setMotion(double t,
                 const Eigen::Ref<const Eigen::VectorXd>& q,
                 const Eigen::Ref<const Eigen::VectorXd>& u);

  const Eigen::MatrixXd& columns() const { return columns_; }  ///< B (free x actuators)

  /// udot = M^-1 (B F - bias). @param F  (actuators) [N|N.m]
  void calcAcceleration(const Eigen::Ref<const Eigen::VectorXd>& F,
                        Eigen::Ref<Eigen::VectorXd> udot) const;
  /// udot = A F + b: A (free x actuators), b (free).
  void calcAffineAcceleration(Eigen::Ref<Eigen::MatrixXd> A, Eigen::Ref<Eigen::VectorXd> b) const;
  /// M udot + bias: what the actuators must supply.
  void calcDemand(const Eigen::Ref<const Eigen::VectorXd>& udot,
                  Eigen::Ref<Eigen::VectorXd> demand) const;

  /// Residual actuators summed up at the pose last set. @param F  (actuators) [N|N.m]
  ResidualSum sumResiduals(const Eigen::Ref<const Eigen::VectorXd>& F) const;

  /// All coordinates of the motion last set.
  const Eigen::VectorXd& q() const { return q_; }
  const Eigen::VectorXd& u() const { return u_; }

 private:
  const FreeCoordinates& free_;
  const ExternalLoads& loads_;
  IdealActuators actuators_;
  ModelState state_;
  std::vector<BodyIndex> actuator_bodies_;
  std::vector<BodyWrench> wrenches_;
  Eigen::VectorXd q_, u_, zero_, tau_;  // all coordinates
  Eigen::MatrixXd full_mass_;           // all coordinates
  Eigen::MatrixXd mass_;                // (free x free)
  Eigen::VectorXd bias_;                // (free)
  Eigen::MatrixXd columns_;             // (free x actuators)
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

}  // namespace gaitmill

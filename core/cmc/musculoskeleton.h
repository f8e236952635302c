#pragma once

#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "core/data/time_series.h"
#include "core/model/external_loads.h"
#include "core/model/free_coordinates.h"
#include "core/model/ideal_actuators.h"
#include "core/model/model.h"
#include "core/model/muscle_paths.h"

namespace gaitmill {

/// Bodies, muscle paths and actuators in the free coordinates:
///   M udot + bias = arms^T F_muscle + columns F_actuator
/// Everything is evaluated at the motion last set. One per thread; members do not allocate.
class Musculoskeleton {
 public:
  /// Keeps references.
  Musculoskeleton(const Model& model,
                  const FreeCoordinates& free,
                  const ExternalLoads& loads,
                  std::vector<ActuatorSpec> actuators);

  const FreeCoordinates& free() const { return free_; }
  const IdealActuators& actuators() const { return actuators_; }
  int muscleCount() const { return static_cast<int>(path_speeds_.size()); }

  /// Poses, velocities and muscle paths. @param q, u  (free) [rad|m], [rad/s|m/s]
  void setMotion(const Eigen::Ref<const Eigen::VectorXd>& q,
                 const Eigen::Ref<const Eigen::VectorXd>& u);

  const Eigen::VectorXd& pathLengths() const { return paths_.lengths(); }  ///< (muscles) [m]
  const Eigen::VectorXd& pathSpeeds() const { return path_speeds_; }       ///< (muscles) [m/s]
  /// Path speeds of another velocity u (all coordinates) at the same pose.
  void calcPathSpeeds(const Eigen::Ref<const Eigen::VectorXd>& u,
                      // NOLINTNEXTLINE(performance-unnecessary-value-param): a Ref is the output
                      Eigen::Ref<Eigen::VectorXd> speeds) const {
    paths_.calcSpeeds(u, speeds);
  }
  /// -dl/dq in free coordinates, (muscles x free) [m|1].
  const RowMatrix& momentArms() const { return arms_; }
  const Eigen::VectorXd& pose() const { return q_; }   ///< all coordinates
  const Eigen::VectorXd& speed() const { return u_; }  ///< all coordinates

  /// M (free x free), bias at time t (free) and the columns of the actuators (free x actuators).
  void calcDynamics(double t);
  const Eigen::MatrixXd& massMatrix() const { return mass_; }
  const Eigen::VectorXd& bias() const { return bias_; }
  const Eigen::MatrixXd& actuatorColumns() const { return columns_; }

  /// udot of the given forces; needs calcDynamics.
  void solveAcceleration(const Eigen::VectorXd& muscle_forces,
                         const Eigen::VectorXd& actuator_forces,
                         Eigen::Ref<Eigen::VectorXd> u_dot);

  long pathEvaluations() const { return path_evaluations_; }

 private:
  const FreeCoordinates& free_;
  const ExternalLoads& loads_;
  IdealActuators actuators_;
  ModelState state_;
  MusclePaths paths_;
  std::vector<BodyWrench> wrenches_;
  Eigen::VectorXd q_, u_;          // all coordinates
  Eigen::VectorXd zero_, tau_;     // all coordinates
  Eigen::MatrixXd full_mass_;      // all coordinates
  Eigen::VectorXd path_speeds_;    // (muscles)
  RowMatrix arms_;                 // (muscles x free)
  Eigen::MatrixXd mass_;           // (free x free)
  Eigen::VectorXd bias_, demand_;  // (free)
  Eigen::MatrixXd columns_;        // (free x actuators)
  Eigen::LLT<Eigen::MatrixXd> factor_;
  long path_evaluations_ = 0;
};

}  // namespace gaitmill

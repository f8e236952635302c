#pragma once

#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "core/analysis/force_record.h"
#include "core/model/free_coordinates.h"
#include "core/model/ideal_actuators.h"
#include "core/model/model.h"
#include "core/model/muscle_paths.h"

namespace gaitmill {

/// A record played back row by row: the bodies in motion and the forces on them. One per thread.
class ForceReplay {
 public:
  /// Keeps references. @throws Error kTableUnknownLabel if a table lacks a column
  ForceReplay(const Model& model, const ForceRecord& record);

  int rowCount() const { return record_.muscle_forces.rowCount(); }
  const std::vector<double>& times() const { return record_.muscle_forces.time; }

  /// Poses, velocities, paths and forces of a row.
  void setRow(int row);

  ModelState& state() { return state_; }
  /// External loads, one per force of the ground reaction.
  const std::vector<BodyWrench>& loads() const { return loads_; }

  /// Accelerations that the forces give, (n_coordinates): forward dynamics with couplers and locks.
  const Eigen::VectorXd& calcAcceleration();
  /// External loads, point and torque actuators, and muscles as tensions along their paths: a pull
  /// on the body of each path vertex towards its neighbours.
  const std::vector<BodyWrench>& calcBodyForces();

  /// Power that the forces give to the bodies [W].
  struct Powers {
    double muscles = 0;    ///< -F dL/dt
    double residuals = 0;  ///< point and torque actuators
    double actuators = 0;  ///< actuators of coordinates and passive forces
    double ground = 0;     ///< external loads
  };
  Powers calcPowers();

 private:
  void addMusclePulls();

  const Model& model_;
  const ForceRecord& record_;
  FreeCoordinates free_;
  IdealActuators actuators_;
  ModelState state_;
  MusclePaths paths_;
  std::vector<int> pose_columns_, speed_columns_, muscle_columns_, actuator_columns_;

  Eigen::VectorXd q_, u_, u_dot_, zero_, tau_;        // (n_coordinates)
  Eigen::VectorXd u_free_, demand_;                   // (n_free)
  Eigen::VectorXd muscle_forces_, path_speeds_;       // (n_muscles)
  Eigen::VectorXd actuator_forces_, actuator_rates_;  // (n_actuators)
  RowMatrix arms_;                                    // (n_muscles x n_free)
  Eigen::MatrixXd columns_;                           // (n_free x n_actuators)
  Eigen::MatrixXd full_mass_, mass_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  std::vector<BodyWrench> loads_, forces_;
  std::vector<PathVertex> path_;
  Matrix6X pulls_;  // (6 x n_bodies)
};

}  // namespace gaitmill

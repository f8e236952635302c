#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/base/progress.h"
#include "core/data/time_series.h"
#include "core/math/diagonal_qp.h"
#include "core/math/qp_problem.h"
#include "core/model/external_loads.h"
#include "core/model/free_coordinates.h"
#include "core/model/ideal_actuators.h"
#include "core/model/model.h"
#include "core/model/muscle_paths.h"
#include "core/model/reference_motion.h"
#include "core/muscle/muscle.h"
#include "core/so/so_options.h"
#include "core/so/so_result.h"

namespace gaitmill {

/// Static optimization (spec/so.md): at every row on its own, the activations that produce the
/// motion at least cost,
///   minimize sum_j |a_j|^p   subject to   sum_j r_j (a_j F_j + P_j) = tau,   bounds on a,
/// with r_j the moment arms in the free coordinates, F_j the force at full activation, P_j the
/// passive force where asked for, and tau the generalized forces of inverse dynamics. Equal to
/// demanding the accelerations, since the reduced mass matrix is invertible. Rows that the bounds
/// do not allow miss as little as possible and are reported, never an error.
/// Deviation from OpenSim 4.6: the pennation in F_j is that of the fiber (spec/so.md 1, quirk), and
/// rows are solved exactly instead of to 1e-4.
/// One per thread; sizes its memory in the constructor.
class SoSolver {
 public:
  /// Keeps a reference to the model. @throws Error kInputValue, kModelReference
  SoSolver(const Model& model, const SoOptions& options);

  /// @param coordinates  [rad|m], rows in time order, filtered already if that is wanted
  /// @throws Error kTableNoRows, kInputTimeRange if no row lies in the range
  SoResult solve(const TimeSeries& coordinates,
                 const ExternalLoads& loads,
                 const Progress& progress = {});

  /// Activations and controls for one instant, (actuatorCount()); does not allocate after the first
  /// call.
  struct Instant {
    double time;                   ///< [s], for the loads
    const Eigen::VectorXd& q;      ///< (n_free) [rad|m]
    const Eigen::VectorXd& u;      ///< (n_free)
    const Eigen::VectorXd& u_dot;  ///< (n_free)
  };
  QpReport solveInstant(const Instant& instant,
                        const ExternalLoads& loads,
                        Eigen::Ref<Eigen::VectorXd> activations);

  const FreeCoordinates& freeCoordinates() const { return free_; }
  /// Muscles and actuators together.
  int actuatorCount() const { return problem_.columns(); }
  std::vector<std::string> actuatorNames() const;

  // Of the last instant:
  /// Force per unit activation, (actuatorCount()) [N|N.m].
  const Eigen::VectorXd& gains() const { return gains_; }
  /// Passive force along the tendon, (n_muscles) [N]; zero where it is off.
  const Eigen::VectorXd& passiveForces() const { return passive_; }
  /// Generalized force of inverse dynamics, (n_free) [N|N.m].
  const Eigen::VectorXd& demand() const { return tau_free_; }
  /// Demand that the bounds did not allow, (n_free) [N|N.m].
  const Eigen::VectorXd& slack() const { return slack_; }
  /// The problem in activations: rows are free coordinates, columns actuators.
  const QpProblem& problem() const { return problem_; }

 private:
  void calcDemand(const Instant& instant, const ExternalLoads& loads);
  void calcMuscleColumns();
  void calcActuatorColumns();
  SoResult makeResult(std::vector<double> time) const;
  void storeRow(int row,
                const Eigen::VectorXd& activations,
                const QpReport& report,
                SoResult& result) const;
  void summarize(SoResult& result) const;

  const Model& model_;
  SoOptions options_;
  FreeCoordinates free_;
  ModelState state_;
  MusclePaths paths_;
  std::vector<Muscle> muscles_;
  IdealActuators actuators_;
  QpProblem problem_;
  DiagonalQp qp_;

  // Workspace.
  Eigen::VectorXd q_, u_, u_dot_, tau_;  // (n_coordinates)
  Eigen::VectorXd tau_free_;             // (n_free)
  Eigen::VectorXd path_speeds_;          // (n_muscles)
  RowMatrix moment_arms_;                // (n_muscles x n_free)
  Eigen::MatrixXd actuator_columns_;     // (n_free x n_actuators)
  Eigen::VectorXd gains_, passive_;
  Eigen::VectorXd slack_;  // (n_free)
  std::vector<BodyWrench> wrenches_;
};

}  // namespace gaitmill

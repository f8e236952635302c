#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/cmc/cmc_options.h"
#include "core/cmc/cmc_state.h"
#include "core/cmc/excitation_limits.h"
#include "core/cmc/muscle_predictor.h"
#include "core/cmc/musculoskeleton.h"
#include "core/math/diagonal_qp.h"
#include "core/math/qp_problem.h"
#include "core/model/reference_motion.h"
#include "core/muscle/muscle.h"

namespace gaitmill {

/// What the controller found in one window, for tests and reports. Sizes: f free coordinates,
/// m muscles, n = m + actuators.
struct CmcWindow {
  double time = 0;                             ///< start [s]
  Eigen::VectorXd position_error;              ///< (f) q_ref - q at the start
  Eigen::VectorXd speed_error;                 ///< (f) u_ref - u at the start
  Eigen::VectorXd wanted_acceleration;         ///< (f) a*
  std::vector<MusclePredictor::Range> ranges;  ///< (m) excitations and forces that can be reached
  Eigen::VectorXd rigid_active_force;          ///< (m) F^ of the cost [N]
  Eigen::VectorXd force;                       ///< (n) solution of the QP [N|N.m]
  Eigen::VectorXd slack;                       ///< (f) missing generalized force [N.m|N]
  QpReport qp;
};

/// Finds the excitations of one window (spec/cmc.md 3, steps 1 to 8): predicts where the muscles
/// can get to, shares the forces that give the desired accelerations, and searches the excitations
/// that lead to them. One per thread; solve() does not allocate with the dual solver.
class CmcController {
 public:
  /// Keeps references to all but `model`.
  CmcController(const ModelSpec& model,
                const std::vector<Muscle>& muscles,
                const ReferenceMotion& reference,
                Musculoskeleton& body,
                const CmcOptions& options);

  /// @param state     at the start of the window
  /// @param duration  of the window [s]
  void solve(const CmcState& state, double duration, CmcControls& controls);

  /// Lets muscle states settle at the pose of `state`, its paths frozen, under given excitations.
  void hold(CmcState& state, double duration, const Eigen::VectorXd& excitation);

  /// Advances the muscle states over the window last solved, kinematics prescribed.
  void followPrediction(CmcState& state, const Eigen::VectorXd& excitation);

  const CmcWindow& window() const { return window_; }
  const MusclePredictor& predictor() const { return predictor_; }
  /// Forgets what earlier windows left behind.
  void reset() { qp_.resetWarmStart(); }

 private:
  void calcErrors(const CmcState& state, double duration);
  void predictPaths(const CmcState& state, double duration);
  void calcRanges(const CmcState& state);
  void fillProblem(double end_time);
  void shareForces();

  const std::vector<Muscle>& muscles_;
  const ReferenceMotion& reference_;
  Musculoskeleton& body_;
  const CmcOptions& options_;
  ExcitationLimits limits_;
  MusclePredictor predictor_;
  QpProblem problem_;
  DiagonalQp qp_;
  CmcWindow window_;
  Eigen::VectorXd q_offset_, u_offset_;  // state minus reference at the start
  Eigen::VectorXd q_, q_dot_, u_;        // prescribed motion
  Eigen::VectorXd full_rates_;           // all coordinates
  Eigen::VectorXd path_slopes_;          // (m)
};

}  // namespace gaitmill

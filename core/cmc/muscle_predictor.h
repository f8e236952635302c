#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/cmc/path_table.h"
#include "core/muscle/muscle.h"

namespace gaitmill {

/// What one muscle does over a window in which its path and excitation are prescribed.
struct MusclePrediction {
  double tendon_force = 0;  ///< at the end of the window [N]
  double activation = 0;    ///< [-]
  double fiber_length = 0;  ///< [m]; only of elastic tendons
};

/// Integrates muscle states over a window with prescribed kinematics (spec/cmc.md 3.4, 6 b-e).
/// Activation advances in closed form; a rigid tendon's force then is explicit; an elastic tendon's
/// fiber is integrated by the implicit half of additive_runge_kutta.h under error control. Muscles
/// are independent of each other. One per thread; members do not allocate.
class MusclePredictor {
 public:
  /// @param max_intervals    pieces of the path table at most
  /// @param fiber_tolerance  error per step [l0M]
  /// Keeps a reference to `muscles`.
  MusclePredictor(const std::vector<Muscle>& muscles, int max_intervals, double fiber_tolerance);

  /// The paths over the window, to be filled before predict().
  PathTable& paths() { return paths_; }
  /// Paths at the end of the window, for rigid tendons. `speeds` need not be the derivative of the
  /// table's lengths: predictions carry a velocity offset (spec/cmc.md 3.1).
  void setEnd(double duration,
              const Eigen::Ref<const Eigen::VectorXd>& lengths,
              const Eigen::Ref<const Eigen::VectorXd>& speeds);

  struct Start {
    double activation;    ///< [-]
    double fiber_length;  ///< [m]; only of elastic tendons
  };
  MusclePrediction predict(int muscle, const Start& start, double excitation);

  /// Excitations that are allowed and the forces they lead to, lower end first.
  struct Range {
    double min_excitation;
    double max_excitation;
    double min_force;
    double max_force;
  };
  /// Excitation in the range whose predicted force is `force`; the nearer end beyond it.
  /// @param tolerance  of the excitation [-]
  double findExcitation(
      int muscle, const Start& start, const Range& range, double force, double tolerance);

  /// F0M fAL fV cos(phi) at the end of the window with a rigid tendon [N] (spec/cmc.md 3.6).
  double rigidActiveForce(int muscle) const {
    return lines_[static_cast<std::size_t>(muscle)].gain;
  }

  long predictions() const { return predictions_; }
  long fiberSteps() const { return fiber_steps_; }
  long rejectedSteps() const { return rejected_steps_; }

 private:
  double integrateFiber(int muscle, const Start& start, double excitation);

  const std::vector<Muscle>& muscles_;
  double fiber_tolerance_;
  PathTable paths_;
  double duration_ = 0;
  Eigen::VectorXd end_lengths_;
  std::vector<Muscle::ForceLine> lines_;
  long predictions_ = 0;
  long fiber_steps_ = 0;
  long rejected_steps_ = 0;
};

}  // namespace gaitmill

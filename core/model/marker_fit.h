#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/base/index.h"
#include "core/data/marker_set.h"
#include "core/math/box_qp.h"
#include "core/model/coordinate_movers.h"
#include "core/model/free_coordinates.h"
#include "core/model/model.h"

namespace gaitmill {

/// How hard a marker fit tries. The defaults stop far below measurement noise, so that the answer
/// does not depend on the start (spec/ik.md 5).
struct MarkerFitOptions {
  double step_tolerance = 1e-8;  ///< [rad|m] largest change of any coordinate at the end
  int max_iterations = 200;
  /// Longest step of a rotation in one iteration [rad], a plain trust region.
  double max_rotation_step = 0.5;
};

enum class FitStop {
  kConverged,       ///< the last step was below the tolerance
  kStalled,         ///< no step lowers the error any more, though the step is not small
  kIterationLimit,  ///< max_iterations were not enough
};

/// What a fit did.
struct MarkerFitSummary {
  double objective = -1;  ///< sum w |x - m|^2 + sum v (q - q*)^2 [m^2]
  int iterations = 0;
  FitStop stop = FitStop::kIterationLimit;
};

/// Part of a fit: only these coordinates move, only these markers pull.
struct FitScope {
  std::vector<bool> coordinates;  ///< one per free coordinate
  std::vector<bool> markers;      ///< one per marker of the fit
};

/// Pose that brings the model's markers closest to measured ones in one frame:
///   q* = argmin sum_i w_i |x_i(q) - m_i|^2 + sum_c v_c (q_c - q*_c)^2
/// over the free coordinates, with couplers and locks eliminated and clamped coordinates inside
/// their range. A marker that is NaN pulls with weight 0.
///
/// Newton's method with the analytic Jacobian and the analytic second derivatives of the tree
/// (d2x/dq_j dq_k = w_j x dx/dq_k for j proximal to k; of a spline knee its own second derivative
/// is left out), Levenberg damping where that is not downhill, and an exact box-constrained step by
/// an active set. One per thread; sizes its memory in the constructor; solve() allocates nothing of
/// its own.
class MarkerFit {
 public:
  /// @param available  names of the measured markers; a task counts if its marker has weight > 0
  ///   and is both measured and in the model, the others are listed by unusedTasks()
  /// @throws Error kInputMarkers if no task counts, kInputCoordinates for an unknown coordinate,
  ///   kInputValue for a negative weight
  MarkerFit(const Model& model,
            const FitTasks& tasks,
            const std::vector<std::string>& available,
            const MarkerFitOptions& options = {});

  /// Markers of the fit, the column order of `measured`.
  const std::vector<std::string>& markers() const { return names_; }
  const std::vector<double>& weights() const { return weights_; }
  /// Body of each marker.
  BodyIndex body(int marker) const;
  /// Tasks that do not count because the marker is not measured or not in the model.
  const std::vector<std::string>& unusedTasks() const { return unused_; }
  /// Free coordinates that no marker and no task pulls; the fit holds them where they start.
  const std::vector<std::string>& heldCoordinates() const { return held_; }
  const Model& model() const { return model_; }
  const FreeCoordinates& freeCoordinates() const { return free_; }
  /// Bounds of the free coordinates, infinite where there are none, (n_free) [rad|m].
  const Eigen::VectorXd& lowerBounds() const { return lower_; }
  const Eigen::VectorXd& upperBounds() const { return upper_; }

  /// @param measured  (3 x markers().size()) [m] in ground, NaN = missing
  /// @param q         (n_coordinates) [rad|m] in: where to start; out: the best pose
  MarkerFitSummary solve(const Eigen::Ref<const Eigen::Matrix3Xd>& measured,
                         Eigen::Ref<Eigen::VectorXd> q);
  /// The same for a part of the unknowns and markers.
  MarkerFitSummary solve(const Eigen::Ref<const Eigen::Matrix3Xd>& measured,
                         const FitScope& scope,
                         Eigen::Ref<Eigen::VectorXd> q);

  /// Distance of each marker from its measurement after the last solve() [m]; NaN where missing.
  const Eigen::VectorXd& errors() const { return errors_; }

  /// Smallest eigenvalue of J^T W J / sum w at the last pose, coordinates that are held or on a
  /// bound left out: how much the worst observed direction moves the markers [m^2/rad^2].
  double calcObservability() const;

 private:
  using Mover = CoordinateMovers::Mover;
  struct FitMarker {
    int body;
    Eigen::Vector3d location;
  };
  struct Target {
    int free;
    double weight;
    double value;
  };

  void findMarkers(const FitTasks& tasks, const std::vector<std::string>& available);
  void findTargets(const FitTasks& tasks);
  void findBounds(const FitTasks& tasks);
  void findHeld();

  double evaluate(const Eigen::VectorXd& q_free);
  void linearize();
  void addMarker(std::size_t marker);
  void addSecondDerivatives();
  /// Step of the damped model; false if the matrix was not positive definite.
  bool calcStep(const Eigen::MatrixXd& hessian, double damping);
  void limitStep();
  void setStepBounds();
  MarkerFitSummary iterate();
  /// Puts a step that lowers the objective into trial_; false if there is none.
  bool descend(double& damping, double& objective);
  void storeErrors();

  const Model& model_;
  MarkerFitOptions options_;
  FreeCoordinates free_;
  CoordinateMovers movers_;
  ModelState state_;
  std::vector<std::string> names_;
  std::vector<double> weights_;
  std::vector<std::string> unused_;
  std::vector<std::string> held_;
  std::vector<FitMarker> markers_;
  std::vector<Target> targets_;
  Eigen::VectorXd lower_, upper_;  ///< (n_free) bounds
  std::vector<bool> rotates_;      ///< per free coordinate
  FitScope everything_;

  // Workspace.
  const FitScope* scope_ = nullptr;
  Eigen::Matrix3Xd measured_, residuals_;     ///< (3 x n_markers)
  std::vector<double> active_weights_;        ///< weights of this frame
  Eigen::VectorXd q_, trial_, full_;          ///< (n_free), (n_free), (n_coordinates)
  Eigen::VectorXd gradient_, step_, errors_;  ///< (n_free), (n_free), (n_markers)
  Eigen::VectorXd step_lower_, step_upper_;   ///< (n_free)
  Eigen::MatrixXd gauss_newton_, newton_;     ///< (n_free x n_free), lower triangles
  Eigen::MatrixXd damped_;                    ///< (n_free x n_free), lower triangle
  Eigen::Matrix3Xd moments_;                  ///< (3 x n_coordinates) sum w x_k x r
  Eigen::Matrix3Xd columns_;                  ///< (3 x n_coordinates) dx/dq of one marker
  BoxQp step_qp_;
};

}  // namespace gaitmill

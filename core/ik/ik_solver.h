#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/base/progress.h"
#include "core/data/marker_trajectories.h"
#include "core/ik/ik_options.h"
#include "core/ik/ik_result.h"
#include "core/model/marker_fit.h"
#include "core/model/model.h"
#include "core/model/pose_search.h"

namespace gaitmill {

/// Coordinates that bring the model markers closest to the measured ones, frame by frame:
///   q(t) = argmin sum_i w_i |x_i(q) - m_i(t)|^2 + sum_c v_c (q_c - q*_c)^2
/// Each frame starts from the previous answer, the first from a search (PoseSearch), and so does a
/// frame whose fit jumps. A marker that is missing in a frame weighs nothing there. Locked
/// coordinates keep their default, clamped ones stay in their range, coupled ones follow.
/// Deviation from OpenSim 4.6: the marker part is not divided by the sum of the visible weights,
/// which matters only beside coordinate tasks (spec/ik.md 1); and each frame is converged to
/// 1e-8 rad, not to 1e-5 m^2 of the objective.
class IkSolver {
 public:
  /// Keeps a reference to the model. @throws Error kInputMarkers, kInputCoordinates, kInputValue
  IkSolver(const Model& model,
           const IkOptions& options,
           const std::vector<std::string>& marker_names);

  /// One frame. @param measured (3 x fit().markers().size()) [m]
  /// @param q  (n_coordinates) in: start, out: answer
  MarkerFitSummary solveFrame(const Eigen::Ref<const Eigen::Matrix3Xd>& measured,
                              Eigen::Ref<Eigen::VectorXd> q);
  /// One frame without a start.
  MarkerFitSummary searchFrame(const Eigen::Ref<const Eigen::Matrix3Xd>& measured,
                               Eigen::Ref<Eigen::VectorXd> q);

  /// The trial. @param trajectories with the marker names given to the constructor
  /// @throws Error kInputTimeRange if the range holds no frame, kInputMarkers if no marker is
  ///   visible in any frame
  IkResult solve(const MarkerTrajectories& trajectories, const Progress& progress = {});

  const MarkerFit& fit() const { return fit_; }

 private:
  void readFrame(const MarkerTrajectories& trajectories, int frame);
  void solveRow(int row, Eigen::VectorXd& q, IkResult& result);
  void storeRow(int row,
                const Eigen::VectorXd& q,
                const MarkerFitSummary& summary,
                IkResult& result) const;

  const Model& model_;
  IkOptions options_;
  MarkerFit fit_;
  PoseSearch search_;
  std::vector<int> columns_;  ///< marker of the fit -> marker of the trajectories
  Eigen::Matrix3Xd measured_;
};

}  // namespace gaitmill

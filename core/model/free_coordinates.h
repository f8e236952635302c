#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/base/index.h"
#include "core/data/time_series.h"
#include "core/model/model.h"

namespace gaitmill {

/// The coordinates that remain when couplers and locks are eliminated (29 of the 39 of
/// Rajagopal2016): q = J q_free + q0 with a constant J, one unit or slope per row. Exact, since the
/// couplers are linear (spec/model.md 6.4, spec/rra.md 9.4). Immutable.
class FreeCoordinates {
 public:
  explicit FreeCoordinates(const Model& model);

  int count() const { return static_cast<int>(indices_.size()); }
  /// Model coordinate of each free coordinate, in model order.
  const std::vector<CoordinateIndex>& indices() const { return indices_; }
  /// Position of a model coordinate among the free ones, or -1 (locked, dependent).
  int findFree(CoordinateIndex c) const;

  /// q (n_coordinates) from q_free (count()). Locked ones get their default value.
  void expandPose(const Eigen::Ref<const Eigen::VectorXd>& q_free,
                  Eigen::Ref<Eigen::VectorXd> q) const;
  /// u = J u_free; the same for accelerations. Locked ones get 0.
  void expandRates(const Eigen::Ref<const Eigen::VectorXd>& u_free,
                   Eigen::Ref<Eigen::VectorXd> u) const;
  /// Picks the free entries out of a full vector.
  void pick(const Eigen::Ref<const Eigen::VectorXd>& full, Eigen::Ref<Eigen::VectorXd> free) const;
  /// Overwrites locked and dependent entries of a full pose (full speeds: `conformRates`).
  void conformPose(Eigen::Ref<Eigen::VectorXd> q) const;
  void conformRates(Eigen::Ref<Eigen::VectorXd> u) const;

  /// tau_free = J^T tau: the force on a dependent coordinate is carried by its independent one.
  void reduceForces(const Eigen::Ref<const Eigen::VectorXd>& tau,
                    Eigen::Ref<Eigen::VectorXd> tau_free) const;
  /// M_free = J^T M J.
  void reduceMassMatrix(const Eigen::Ref<const Eigen::MatrixXd>& M,
                        Eigen::Ref<Eigen::MatrixXd> M_free) const;
  /// (n x n_coordinates) -> (n x count()): columns combined as forces are. For moment arms.
  void reduceColumns(const Eigen::Ref<const RowMatrix>& full, Eigen::Ref<RowMatrix> reduced) const;

 private:
  struct Source {
    int free = -1;      ///< free coordinate that drives it, -1 = locked
    double slope = 1;   ///< d q / d q_free
    double offset = 0;  ///< q at q_free = 0; the locked value
  };
  std::vector<CoordinateIndex> indices_;
  std::vector<Source> sources_;  ///< one per model coordinate
};

}  // namespace gaitmill

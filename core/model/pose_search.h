#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/model/marker_fit.h"
#include "core/model/model.h"

namespace gaitmill {

/// Finds the pose of a frame without knowing where to begin (spec/ik.md 5): fits the root body to
/// its own markers from several headings, then joint after joint outward, each ball-like joint from
/// several directions, and last everything together. Avoids the half-turn traps of a cold start,
/// for instance of arms that are raised sideways. Costs some hundred iterations of the fit.
class PoseSearch {
 public:
  /// Keeps references to both; the fit's scope and workspace are used.
  PoseSearch(const Model& model, MarkerFit& fit);

  /// @param measured  (3 x fit.markers().size()) [m], NaN = missing
  /// @param q         (n_coordinates) out: the best pose found; the input is ignored
  MarkerFitSummary solve(const Eigen::Ref<const Eigen::Matrix3Xd>& measured,
                         Eigen::Ref<Eigen::VectorXd> q);

 private:
  /// What one joint adds to the tree.
  struct Limb {
    FitScope own;                ///< the joint's coordinates, the markers of its child body
    FitScope outward;            ///< the same and everything further out
    std::vector<int> rotations;  ///< model coordinates of the joint that rotate
    CoordinateIndex first;       ///< the joint's first free coordinate; invalid if it has none
    bool is_root = false;
  };

  void findLimbs();
  Limb makeLimb(const JointSpec& joint) const;
  void addOutward(const JointSpec& joint, Limb& limb) const;
  bool isWellSeen(const FitScope& scope, const Eigen::Ref<const Eigen::Matrix3Xd>& measured) const;
  std::vector<Eigen::VectorXd> makeStarts(const Limb& limb, const Eigen::VectorXd& q) const;
  MarkerFitSummary fitFromBestStart(const Eigen::Ref<const Eigen::Matrix3Xd>& measured,
                                    const Limb& limb,
                                    const FitScope& scope,
                                    Eigen::Ref<Eigen::VectorXd> q);

  const Model& model_;
  MarkerFit& fit_;
  std::vector<Limb> limbs_;  ///< from the root outward
};

}  // namespace gaitmill

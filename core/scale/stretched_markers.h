#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/model/model.h"
#include "core/scale/scale_groups.h"

namespace gaitmill {

/// Bodies, joints and markers of a model without what does not move markers: no mass, muscles or
/// surfaces.
ModelSpec makeKinematicModel(const ModelSpec& model);

/// Marker positions of a model whose sizes are still unknown. Rotations do not depend on sizes, and
/// every body-fixed point and joint translation scales linearly with them (spec/scale.md 2), so
/// that
///   x_m(q, s, d) = x0_m(q) + sum_g s_g A_gm(q) + R_b(q) d_m
/// for sizes s of the groups and offsets d of the markers in their bodies. x0 is the model with all
/// sizes 0 and A_g what size 1 of group g adds: each a model of its own, made by
/// applyScaleFactors(), so that the rules of scaling stand in one place. The screws of coordinates
/// are linear in s in the same way. One per thread.
class StretchedMarkers {
 public:
  /// @param markers  names of markers of the model. @throws Error kModelReference
  StretchedMarkers(const ModelSpec& generic,
                   const std::vector<ScaleGroup>& groups,
                   const std::vector<std::string>& markers);

  /// Of all sizes 0; its coordinates and tree are those of every size.
  const Model& model() const { return models_.front(); }
  int groupCount() const { return static_cast<int>(models_.size()) - 1; }
  int markerCount() const { return static_cast<int>(bodies_.size()); }
  BodyIndex body(int marker) const { return bodies_[static_cast<std::size_t>(marker)]; }
  /// Groups that the position of the marker depends on, in any pose.
  const std::vector<int>& groups(int marker) const;

  /// @param q (n_coordinates) [rad|m]
  void setPose(const Eigen::Ref<const Eigen::VectorXd>& q);

  const Eigen::Matrix3d& rotation(BodyIndex body) const { return states_.front().pose(body).R; }
  Eigen::Vector3d base(int marker) const;               ///< x0_m [m]
  Eigen::Vector3d column(int group, int marker) const;  ///< A_gm [m]
  /// Screws at the ground origin: of sizes 0, and what size 1 of a group adds.
  const Matrix6X& baseScrews() const { return states_.front().screws(); }
  Eigen::Vector3d screwColumn(int group, int coordinate) const;  ///< linear part; nothing turns

 private:
  void findGroups(const ModelSpec& generic, const std::vector<ScaleGroup>& groups);

  std::vector<Model> models_;       ///< all sizes 0, then one per group
  std::vector<ModelState> states_;  ///< one per model
  std::vector<BodyIndex> bodies_;   ///< per marker
  /// Per model and marker: location in the body [m].
  std::vector<std::vector<Eigen::Vector3d>> locations_;
  std::vector<std::vector<int>> groups_;  ///< per marker
};

}  // namespace gaitmill

#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "core/data/time_series.h"
#include "core/model/model.h"

namespace gaitmill {

/// A point that a path runs through. Between two vertices the path is straight.
struct PathVertex {
  Eigen::Vector3d p_G = Eigen::Vector3d::Zero();
  BodyIndex
      body;  ///< that the tendon touches here: of a path point, or of the surface wrapped over
};

/// Lengths and moment arms of all muscle paths at once, wrapped over cylinders, spheres and
/// ellipsoids as true geodesics (spec/path.md, exact mode: closed form per cylinder and sphere,
/// several surfaces iterated to convergence).
/// Moving points contribute to lengths, speeds and moment arms by their own motion on their body;
/// beyond the range of their coordinate they rest, with derivative 0 (OpenSim extrapolates there).
/// Conditional points come and go with the pose: lengths and arms jump at the ends of their ranges,
/// which count as inside within 1e-5. The arms are the derivatives of the path as it is, points
/// fixed in number. One per thread. Stateless between calls; calc() does not allocate.
class MusclePaths {
 public:
  explicit MusclePaths(const Model& model);  ///< keeps a reference to the model
  ~MusclePaths();
  MusclePaths(MusclePaths&&) noexcept;
  MusclePaths(const MusclePaths&) = delete;
  MusclePaths& operator=(const MusclePaths&) = delete;

  /// Evaluates every path at the pose of `state`.
  void calc(const ModelState& state);

  /// Origin to insertion along the wrapped path, (n_muscles) [m].
  const Eigen::VectorXd& lengths() const;

  /// r = -dl/dq of each coordinate ALONE, (n_muscles x n_coordinates) [m|1]; couplers are not
  /// applied: use FreeCoordinates::reduceColumns, which adds the patella's arm to the knee's.
  const RowMatrix& momentArms() const;

  /// Lengthening speeds -r u, (n_muscles) [m/s]: exact for geodesics (envelope theorem).
  void calcSpeeds(const Eigen::Ref<const Eigen::VectorXd>& u,
                  Eigen::Ref<Eigen::VectorXd> speeds) const;

  /// Number of surfaces that the path touched in the last calc(): changes mark kinks of dl/dt.
  int findWrapCount(MuscleIndex muscle) const;

  /// One path from origin to insertion at the pose of `state`, as calc() finds it, its arcs over
  /// surfaces as chords. A tension along the path pulls each vertex's body towards its neighbours.
  /// @param arc_step  largest turn between two vertices of an arc [rad] > 0
  void tracePath(const ModelState& state,
                 MuscleIndex muscle,
                 double arc_step,
                 std::vector<PathVertex>& vertices);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gaitmill

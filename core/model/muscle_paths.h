#pragma once

#include <memory>

#include <Eigen/Core>

#include "core/data/time_series.h"
#include "core/model/model.h"

namespace gaitmill {

/// Lengths and moment arms of all muscle paths at once, wrapped over cylinders as true geodesics
/// (spec/path.md, exact mode: closed form per cylinder, several cylinders iterated to convergence).
/// One per thread. Stateless between calls; calc() does not allocate.
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

  /// Number of cylinders that the path touched in the last calc(): changes mark kinks of dl/dt.
  int findWrapCount(MuscleIndex muscle) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gaitmill

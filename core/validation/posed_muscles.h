#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/base/index.h"
#include "core/data/model_spec.h"
#include "core/data/time_series.h"
#include "core/model/free_coordinates.h"
#include "core/model/model.h"
#include "core/model/muscle_paths.h"
#include "core/muscle/muscle.h"

namespace gaitmill {

/// Where one coordinate stands [rad|m].
struct CoordinateValue {
  std::string coordinate;
  double value = 0;
};

/// What a muscle at rest in length pulls with, along its tendon [N].
struct IsometricForce {
  double total = 0;         ///< tendon force
  double passive = 0;       ///< the part of the stretched fiber, F0M fPE cos(phi)
  double fiber_length = 0;  ///< [m]
};

/// Static equilibrium of fiber and tendon at zero velocity (spec/muscle.md 6.1, 7).
/// @param activation   [-] raised to the muscle's minimum
/// @param path_length  [m]
IsometricForce calcIsometricForce(const Muscle& muscle, double activation, double path_length);

/// The muscles of a model held still in chosen poses: lengths, moment arms and forces as an
/// anatomist or a dynamometer would find them. One per thread.
class PosedMuscles {
 public:
  /// Locks of the document are released: a figure may move any coordinate. Masses and inertias are
  /// not those of the document, which need not be sound.
  /// @throws Error as Model and makeMuscles
  explicit PosedMuscles(const ModelSpec& model);
  PosedMuscles(const PosedMuscles&) = delete;
  PosedMuscles& operator=(const PosedMuscles&) = delete;

  const Model& model() const { return model_; }
  const Muscle& muscle(MuscleIndex m) const {
    return muscles_[static_cast<std::size_t>(m.value())];
  }

  /// Coordinates that are not listed stand at 0 (or the nearest end of a clamped range), locked
  /// ones at their default, dependent ones where their coupler puts them.
  /// @throws Error kInputCoordinates if a listed coordinate does not exist
  void setPose(const std::vector<CoordinateValue>& pose);
  /// The same from a full vector of coordinates (n_coordinates) [rad|m].
  void setPose(const Eigen::Ref<const Eigen::VectorXd>& q);

  /// Origin to insertion [m].
  double findLength(MuscleIndex m) const { return paths_.lengths()[m.value()]; }

  /// -dl/dq along the couplers: the knee's arm includes the patella's [m].
  /// @param free  a coordinate that no coupler drives
  double findMomentArm(MuscleIndex m, CoordinateIndex free) const;

  /// calcIsometricForce on the path of the pose.
  IsometricForce calcForce(MuscleIndex m, double activation) const {
    return calcIsometricForce(muscle(m), activation, findLength(m));
  }

 private:
  Model model_;
  FreeCoordinates free_;
  std::vector<Muscle> muscles_;
  Eigen::VectorXd neutral_;  ///< pose of coordinates that are not listed
  Eigen::VectorXd q_;
  ModelState state_;
  MusclePaths paths_;
  RowMatrix arms_;  ///< (n_muscles x n_free) [m]
};

}  // namespace gaitmill

#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/data/time_series.h"
#include "core/model/free_coordinates.h"
#include "core/model/model.h"
#include "core/model/muscle_paths.h"
#include "core/render/bones.h"

namespace gaitmill {

/// A model with its bones, to be put into poses. Not to be shared between threads.
class Subject {
 public:
  /// @param geometry_folder  see readBones; "" = stylised bones
  /// @throws Error of the model reader
  Subject(const std::string& model_osim, const std::string& geometry_folder);

  const Model& model() const { return model_; }
  const std::vector<BodyMesh>& bones() const { return bones_; }

  /// The pose of a motion at a time, couplers and locks satisfied. Coordinates that the table lacks
  /// have their default values; a table without columns gives the default pose.
  /// @param time  [s]; outside the table its nearest end
  /// @throws Error kInputCoordinates if a coordinate has no value then
  void setPose(const TimeSeries& kinematics, double time);

  const Pose& pose(BodyIndex body) const { return state_.pose(body); }
  /// Ground below the body that the model hangs on: the pelvis of gait models [m].
  Eigen::Vector3d findFollowPoint() const;
  /// In ground [m], in the model's order.
  Eigen::Vector3d findMarker(int marker) const;
  /// The path of a muscle in the current pose, arcs as chords of at most 8 degrees.
  void tracePath(MuscleIndex muscle, std::vector<PathVertex>& vertices);

 private:
  Model model_;
  FreeCoordinates free_;
  ModelState state_;
  MusclePaths paths_;
  std::vector<BodyMesh> bones_;
  BodyIndex root_ = kGround;
};

}  // namespace gaitmill

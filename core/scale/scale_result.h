#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/data/model_spec.h"
#include "core/data/time_series.h"

namespace gaitmill {

/// Factors of one body along its own axes.
struct BodyScale {
  std::string body;
  Eigen::Vector3d factors = Eigen::Vector3d::Ones();
};

/// One marker pair of a measurement.
struct PairResult {
  std::string first;
  std::string second;
  double measured = -1;          ///< [m] mean over the frames where both are visible
  double in_model = -1;          ///< [m] in the default pose
  double visible_fraction = -1;  ///< of the frames in the range
  double factor = -1;            ///< measured / in_model
};

/// What became of a measurement.
enum class MeasurementUse {
  kApplied,
  kLimited,     ///< applied at the limit that another measurement sets
  kUnmeasured,  ///< none of its pairs could be measured
  kRefused,     ///< its factor is implausible
  kNotNeeded,   ///< an earlier alternative counts
};

struct MeasurementResult {
  std::string name;
  double factor = -1;  ///< as applied, else the mean over the pairs; -1 if it was not measured
  std::vector<PairResult> pairs;
  MeasurementUse use = MeasurementUse::kUnmeasured;
};

/// Fit of one static pose and what it did to the markers.
struct PlacementResult {
  TimeSeries pose;                   ///< one row, all coordinates [rad|m]
  std::vector<std::string> markers;  ///< weighted ones
  std::vector<double> errors;        ///< [m] before the markers were moved
  double rms = -1;                   ///< [m] over the weighted markers
  double max_error = -1;             ///< [m]
  std::string worst_marker;
  std::vector<std::string> moved_markers;
  std::vector<std::string> removed_markers;  ///< in the model, not in the file
  int iterations = 0;
  bool converged = false;
};

/// One size of the subject as a motion fit found it.
struct SizeEstimate {
  std::string name;       ///< "femur", "pelvis_x"
  double factor = -1;     ///< [-] on the generic model
  double expected = -1;   ///< height / generic height
  double deviations = 0;  ///< (factor - expected) in standard deviations of the prior
  bool at_bound = false;  ///< the factor was stopped by its bound
};

/// Where a motion fit moved a marker, from its place on the stretched generic model.
struct OffsetEstimate {
  std::string marker;
  double distance = -1;   ///< [m]
  double deviations = 0;  ///< distance in standard deviations of the prior along one axis
};

/// Sizes, marker offsets and poses fitted together to frames of a motion.
struct MotionFitResult {
  std::vector<double> times;         ///< [s] of the frames
  std::vector<std::string> markers;  ///< weighted ones
  std::vector<SizeEstimate> sizes;
  std::vector<OffsetEstimate> offsets;       ///< of the movable markers
  std::vector<std::string> moved_markers;    ///< those and unweighted ones put where they are seen
  std::vector<std::string> removed_markers;  ///< in the model, not in the file
  // Unweighted RMS distance of visible markers [m], first with the generic model stretched evenly
  // to the subject's height: over the frames fitted, and mean over the frames of the motion, each
  // posed by itself.
  double frames_rms_before = -1, frames_rms = -1;
  double motion_rms_before = -1, motion_rms = -1;
  int iterations = 0;
  bool converged = false;
};

/// A model of the subject and how it came about.
struct ScaleResult {
  ModelSpec model;
  std::vector<BodyScale> factors;  ///< one per body, in model order
  std::vector<MeasurementResult> measurements;
  std::vector<PlacementResult> placements;
  std::optional<MotionFitResult> motion;  ///< set where the motion took the place of a static trial
  double mass = -1;                       ///< [kg]
  /// Rounds of scaling and fitting until the factors stood still; 0 if all distances are those of
  /// the default pose.
  int pose_rounds = 0;
  std::vector<std::string> warnings;
};

}  // namespace gaitmill

#pragma once

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/data/model_spec.h"

namespace gaitmill {

// What a laboratory knows about its markers: where they sit on the model, which distances size the
// body segments, and how much each marker is trusted. Plain values; SI units and radians.

/// Interval of a recording [s], inclusive; the default takes everything there is.
struct TimeRange {
  double start = -std::numeric_limits<double>::infinity();
  double end = std::numeric_limits<double>::infinity();
};

/// Two markers whose measured distance is compared with the model's.
struct MarkerPair {
  std::string first;
  std::string second;
};

/// A point computed from measured markers in every frame of a static trial. It then counts as
/// measured: pairs and placements may name it, and `markers` says where it sits on the model.
struct VirtualMarkerSpec {
  enum class Rule {
    kMean,  ///< mean of the sources
    /// Hip centre after Harrington et al. (2007), J Biomech 40:595 (spec/scale.md 7.3). Sources:
    /// right ASIS, left ASIS, then right and left PSIS, or one point between them.
    kRightHipCenter,
    kLeftHipCenter,
  };
  std::string name;
  Rule rule = Rule::kMean;
  std::vector<std::string> sources;  ///< where one is missing in a frame, the point is missing
};

/// Limits of a factor relative to another measurement's, for distances that are measured badly: a
/// shoe's sole counts as height of the foot.
struct FactorLimit {
  std::string measurement;  ///< one that comes before
  double min_ratio = 0;
  double max_ratio = std::numeric_limits<double>::infinity();
};

/// Mean of (measured / model distance) over the pairs, applied to some axes of some bodies
/// (spec/scale.md 1).
struct MeasurementSpec {
  std::string name;
  std::vector<MarkerPair> pairs;
  std::vector<std::string> bodies;
  std::array<bool, 3> axes = {true, true, true};  ///< X, Y, Z of the body
  /// Whether a pair that cannot be measured is an error; otherwise it is left out with a warning.
  bool required = true;
  /// Model distances are those of the pose fitted to the static trial rather than of the default
  /// pose, repeated until the factors stand still: for pairs that cross a joint.
  bool in_fitted_pose = false;
  /// Measurements of one group are alternatives: the first that gives a factor counts.
  std::string alternative_of;
  /// A factor outside is refused with a warning that names it.
  double min_factor = 0;
  double max_factor = std::numeric_limits<double>::infinity();
  /// A factor beyond is set to the limit with a warning.
  std::optional<FactorLimit> limit;
};

/// Factors that are set rather than measured.
struct ManualScaleSpec {
  std::vector<std::string> bodies;
  Eigen::Vector3d factors = Eigen::Vector3d::Ones();
};

/// Which of the two kinds of factors is applied first; where both name an axis, the later one wins.
enum class ScalingOrder { kMeasurementsThenManual, kManualThenMeasurements };

/// Trust in one marker of a fit.
struct MarkerWeight {
  std::string marker;
  double weight = 0;  ///< >= 0; 0 leaves the marker out
};

/// Pull of one coordinate towards a value: adds weight (q - value)^2 to the marker errors.
struct CoordinateTask {
  std::string coordinate;
  double weight = 0;            ///< >= 0 [m^2/rad^2 or 1]
  std::optional<double> value;  ///< [rad|m]; absent = the model's default
};

/// Replaces the range of one coordinate during a fit, for instance the heading of a static trial.
struct CoordinateRange {
  std::string coordinate;
  double min = -std::numeric_limits<double>::infinity();  ///< [rad|m]
  double max = std::numeric_limits<double>::infinity();
};

/// Tasks of a weighted marker fit. Markers that are not listed are left out.
struct FitTasks {
  std::vector<MarkerWeight> markers;
  std::vector<CoordinateTask> coordinates;
  std::vector<CoordinateRange> ranges;
};

/// One static pose on which the movable markers are placed.
struct PlacementSpec {
  TimeRange range;  ///< frames that are averaged
  /// A marker pulls if it is seen in so many of them; 1 is OpenSim's rule.
  double min_visible_fraction = 1;
  FitTasks tasks;
};

/// Everything that depends on the marker set of a laboratory.
struct MarkerSetSpec {
  std::string name;
  std::string description;
  std::vector<MarkerSpec> markers;  ///< added to the model, replacing those of the same name
  /// How far a marker may sit from its place on the model, one standard deviation along one axis
  /// [m]; what scaling by the motion believes. Not listed: by what the marker is used for.
  std::map<std::string, double> place_deviations;
  std::vector<VirtualMarkerSpec> virtual_markers;  ///< added to the static trials
  /// Factor of every body before anything is measured, and in the end of those that nothing
  /// measures: the subject's height over the model's.
  double size_ratio = 1;
  TimeRange measurement_range;  ///< frames of the static trial whose distances are averaged
  ScalingOrder order = ScalingOrder::kMeasurementsThenManual;
  std::vector<MeasurementSpec> measurements;
  std::vector<ManualScaleSpec> manual;
  bool preserve_mass_distribution = true;
  std::vector<PlacementSpec> placements;  ///< one per static file, in order
  FitTasks ik;
};

}  // namespace gaitmill

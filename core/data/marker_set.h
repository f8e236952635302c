#pragma once

#include <array>
#include <limits>
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

/// Mean of (measured / model distance) over the pairs, applied to some axes of some bodies
/// (spec/scale.md 1).
struct MeasurementSpec {
  std::string name;
  std::vector<MarkerPair> pairs;
  std::vector<std::string> bodies;
  std::array<bool, 3> axes = {true, true, true};  ///< X, Y, Z of the body
  /// Whether a pair that cannot be measured is an error; otherwise it is left out with a warning.
  bool required = true;
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
  FitTasks tasks;
};

/// Everything that depends on the marker set of a laboratory.
struct MarkerSetSpec {
  std::string name;
  std::string description;
  std::vector<MarkerSpec> markers;  ///< added to the model, replacing those of the same name
  TimeRange measurement_range;      ///< frames of the static trial whose distances are averaged
  ScalingOrder order = ScalingOrder::kMeasurementsThenManual;
  std::vector<MeasurementSpec> measurements;
  std::vector<ManualScaleSpec> manual;
  bool preserve_mass_distribution = true;
  std::vector<PlacementSpec> placements;  ///< one per static file, in order
  FitTasks ik;
};

}  // namespace gaitmill

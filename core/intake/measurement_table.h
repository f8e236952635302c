#pragma once

#include <array>
#include <string>
#include <vector>

namespace gaitmill {

// Which distances size which body segments, as a table (spec/scale.md 7). Names of landmarks,
// points and bodies are those of the right side without its letter; a name that the middle has
// stands for both.

/// A point of the skeleton and the ways to get it: the first whose landmarks are all measured. More
/// than one landmark means their mean.
struct SkeletonPoint {
  std::string name;  ///< "KNEE"
  bool sided = true;
  std::vector<std::vector<std::string>> ways;
};

/// One way to size a group of bodies. Lines of one group are tried from the first to the last.
struct MeasurementLine {
  std::string group;   ///< "femur"
  std::string reason;  ///< why this line stands where it does, for people
  /// Pairs of points or landmarks; "<" before a name means the left side, ">" the right, in pairs
  /// across the body. All pairs that can be measured count; one is enough.
  std::vector<std::array<std::string, 2>> pairs;
  std::vector<std::string> bodies;
  std::array<bool, 3> axes = {true, true, true};
  bool in_fitted_pose = false;  ///< crosses a joint
};

/// Limits between the factors of two groups.
struct GroupLimit {
  std::string group;
  std::string beside;  ///< a group that comes before
  double min_ratio;
  double max_ratio;
};

const std::vector<SkeletonPoint>& skeletonPoints();
const std::vector<MeasurementLine>& measurementLines();
const std::vector<GroupLimit>& groupLimits();

}  // namespace gaitmill

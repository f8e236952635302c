#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/data/time_series.h"

namespace gaitmill {

/// Measured marker positions over time, in the ground frame (X forward, Y up, Z to the right) [m].
/// A marker that is missing in a frame is NaN in all three components.
struct MarkerTrajectories {
  std::vector<std::string> names;
  double rate = 0;           ///< [Hz] as the file states it; 0 if unknown
  std::vector<double> time;  ///< [s] strictly increasing
  RowMatrix positions;       ///< (time.size() x 3 names.size()): x y z of each marker in turn

  int frameCount() const { return static_cast<int>(time.size()); }
  int markerCount() const { return static_cast<int>(names.size()); }
  std::optional<int> findMarker(const std::string& name) const;
  Eigen::Vector3d position(int frame, int marker) const {
    return positions.row(frame).segment<3>(Eigen::Index{3} * marker).transpose();
  }
  bool isMissing(int frame, int marker) const;
};

}  // namespace gaitmill

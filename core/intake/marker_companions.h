#pragma once

#include <optional>
#include <vector>

#include "core/data/marker_trajectories.h"

namespace gaitmill {

/// Another marker at a nearly constant distance, mostly on the same segment.
struct Companion {
  int marker = 0;       ///< in MarkerTrajectories::names
  double distance = 0;  ///< [m] median over the recording
  double spread = 0;    ///< [m] robust standard deviation of the distance
};

/// Companions of every marker, the most constant ones first, six at most: markers within 0.7 m
/// whose distance spreads less than 8 mm, which is what skin moves on bone. They are found from the
/// data: names and models are not needed, and a fault in less than a third of the frames does not
/// change medians.
class MarkerCompanions {
 public:
  explicit MarkerCompanions(const MarkerTrajectories& markers);

  const std::vector<Companion>& of(int marker) const {
    return companions_[static_cast<std::size_t>(marker)];
  }

  /// How far a position is from where a marker's companions have it [m]: the median over the
  /// visible companions of |distance - usual distance|. Nullopt if fewer than two are visible.
  /// @param position  taken for the marker's in this frame
  /// @param without   a marker that is not to be asked, or -1
  std::optional<double> findResidual(const MarkerTrajectories& markers,
                                     int frame,
                                     int marker,
                                     const Eigen::Vector3d& position,
                                     int without = -1) const;

 private:
  std::vector<std::vector<Companion>> companions_;
};

}  // namespace gaitmill

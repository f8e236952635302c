#include "core/analysis/marker_statistics.h"

#include <cmath>
#include <cstddef>
#include <limits>

#include "core/base/error.h"

namespace gaitmill {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

MarkerStatistics calcOne(const TimeSeries& distances, int column) {
  MarkerStatistics marker;
  marker.marker = distances.labels[static_cast<std::size_t>(column)];
  double sum = 0;
  double squares = 0;
  int seen = 0;
  for (int row = 0; row < distances.rowCount(); ++row) {
    const double distance = distances.values(row, column);
    if (!std::isfinite(distance)) {
      continue;
    }
    ++seen;
    sum += distance;
    squares += distance * distance;
    if (marker.max_frame < 0 || distance > distances.values(marker.max_frame, column)) {
      marker.max_frame = row;
    }
  }
  marker.visible_fraction = static_cast<double>(seen) / distances.rowCount();
  marker.mean = seen > 0 ? sum / seen : kNan;
  marker.rms = seen > 0 ? std::sqrt(squares / seen) : kNan;
  marker.max = seen > 0 ? distances.values(marker.max_frame, column) : kNan;
  marker.max_time = seen > 0 ? distances.time[static_cast<std::size_t>(marker.max_frame)] : kNan;
  return marker;
}

}  // namespace

std::vector<MarkerStatistics> calcMarkerStatistics(const TimeSeries& distances,
                                                   const std::vector<double>& weights) {
  require(distances.rowCount() > 0, ErrorCode::kTableNoRows, "there are no frames to judge");
  check(weights.size() == distances.labels.size(), "every marker has a weight");
  std::vector<MarkerStatistics> markers;
  for (int column = 0; column < distances.columnCount(); ++column) {
    markers.push_back(calcOne(distances, column));
    markers.back().weight = weights[static_cast<std::size_t>(column)];
  }
  return markers;
}

}  // namespace gaitmill

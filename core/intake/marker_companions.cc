#include "core/intake/marker_companions.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gaitmill {

namespace {

constexpr double kFarthest = 0.7;         // [m] a segment's length
constexpr double kLargestSpread = 0.008;  // [m]
constexpr std::size_t kMostCompanions = 6;
constexpr double kNormalOverMad = 1.4826;  // standard deviation over median absolute deviation
constexpr int kMostSamples = 300;          // frames that a distance is looked at in
constexpr int kFewestSamples = 10;

double takeMedian(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

MarkerCompanions::MarkerCompanions(const MarkerTrajectories& markers)
    : companions_(static_cast<std::size_t>(markers.markerCount())) {
  const int step = std::max(1, markers.frameCount() / kMostSamples);
  std::vector<double> distances;
  for (int i = 0; i < markers.markerCount(); ++i) {
    for (int j = i + 1; j < markers.markerCount(); ++j) {
      distances.clear();
      for (int frame = 0; frame < markers.frameCount(); frame += step) {
        const double distance = (markers.position(frame, i) - markers.position(frame, j)).norm();
        if (std::isfinite(distance)) {
          distances.push_back(distance);
        }
      }
      if (distances.size() < kFewestSamples) {
        continue;
      }
      const double median = takeMedian(distances);
      for (double& distance : distances) {
        distance = std::abs(distance - median);
      }
      const double spread = kNormalOverMad * takeMedian(distances);
      if (median < kFarthest && spread < kLargestSpread) {
        companions_[static_cast<std::size_t>(i)].push_back({j, median, spread});
        companions_[static_cast<std::size_t>(j)].push_back({i, median, spread});
      }
    }
  }
  for (std::vector<Companion>& list : companions_) {
    std::sort(list.begin(), list.end(), [](const Companion& a, const Companion& b) {
      return a.spread < b.spread;
    });
    list.resize(std::min(list.size(), kMostCompanions));
  }
}

std::optional<double> MarkerCompanions::findResidual(const MarkerTrajectories& markers,
                                                     int frame,
                                                     int marker,
                                                     const Eigen::Vector3d& position,
                                                     int without) const {
  std::array<double, kMostCompanions> residuals;
  std::size_t count = 0;
  for (const Companion& companion : of(marker)) {
    const double distance = (position - markers.position(frame, companion.marker)).norm();
    if (companion.marker != without && std::isfinite(distance)) {
      residuals[count++] = std::abs(distance - companion.distance);
    }
  }
  if (count < 2) {
    return std::nullopt;
  }
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(
      residuals.begin(), middle, residuals.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

}  // namespace gaitmill

#include "core/intake/still_range.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/base/error.h"
#include "core/base/text.h"

namespace gaitmill {

namespace {

/// Standing people sway by some millimetres within seconds (own choice: half of what the static
/// pose may miss its markers by).
constexpr double kStillSway = 0.005;  // [m]
constexpr double kWindow = 0.5;       // [s]
/// Fewer frames do not average marker noise.
constexpr int kFewFrames = 10;
/// A marker seen in fewer frames is named.
constexpr double kMinVisible = 0.8;

/// Sums over frames, so that any window costs two look-ups per marker.
class SwaySums {
 public:
  explicit SwaySums(const MarkerTrajectories& trial)
      : count_(RowMatrix::Zero(trial.frameCount() + 1, trial.markerCount())),
        square_(count_),
        sum_(RowMatrix::Zero(trial.frameCount() + 1, Eigen::Index{3} * trial.markerCount())) {
    for (int frame = 0; frame < trial.frameCount(); ++frame) {
      count_.row(frame + 1) = count_.row(frame);
      square_.row(frame + 1) = square_.row(frame);
      sum_.row(frame + 1) = sum_.row(frame);
      for (int m = 0; m < trial.markerCount(); ++m) {
        if (!trial.isMissing(frame, m)) {
          add(frame + 1, m, trial.position(frame, m) - findOrigin(trial, m));
        }
      }
    }
  }

  /// Median over the markers of their RMS distance from their mean [m]; markers seen in less than
  /// half of the window are left out. Infinite without any.
  double calcSway(int first, int last) const {
    std::vector<double> sways;
    for (Eigen::Index m = 0; m < count_.cols(); ++m) {
      const double n = count_(last + 1, m) - count_(first, m);
      if (2 * n < last - first + 1 || n < 1) {
        continue;
      }
      const Eigen::Vector3d mean =
          (sum_.row(last + 1) - sum_.row(first)).segment<3>(3 * m).transpose() / n;
      const double variance = (square_(last + 1, m) - square_(first, m)) / n - mean.squaredNorm();
      sways.push_back(std::sqrt(std::max(0.0, variance)));
    }
    if (sways.empty()) {
      return std::numeric_limits<double>::infinity();
    }
    const auto middle = sways.begin() + static_cast<std::ptrdiff_t>(sways.size() / 2);
    std::nth_element(sways.begin(), middle, sways.end());
    return *middle;
  }

 private:
  // Near zero sums keep their digits.
  static Eigen::Vector3d findOrigin(const MarkerTrajectories& trial, int marker) {
    for (int frame = 0; frame < trial.frameCount(); ++frame) {
      if (!trial.isMissing(frame, marker)) {
        return trial.position(frame, marker);
      }
    }
    return Eigen::Vector3d::Zero();
  }
  void add(int row, int marker, const Eigen::Vector3d& point) {
    count_(row, marker) += 1;
    square_(row, marker) += point.squaredNorm();
    sum_.row(row).segment<3>(Eigen::Index{3} * marker) += point.transpose();
  }

  RowMatrix count_, square_, sum_;
};

/// Names of the markers that are missing in too many frames of the window.
std::string listGaps(const MarkerTrajectories& trial, int first, int last) {
  std::string list;
  for (int m = 0; m < trial.markerCount(); ++m) {
    int seen = 0;
    for (int frame = first; frame <= last; ++frame) {
      seen += trial.isMissing(frame, m) ? 0 : 1;
    }
    if (seen < kMinVisible * (last - first + 1)) {
      list += (list.empty() ? "" : ", ") + trial.names[static_cast<std::size_t>(m)] + " (" +
              formatFixed(100.0 * seen / (last - first + 1), 0) + " %)";
    }
  }
  return list;
}

bool seesAnything(const MarkerTrajectories& trial) {
  for (int frame = 0; frame < trial.frameCount(); ++frame) {
    for (int m = 0; m < trial.markerCount(); ++m) {
      if (!trial.isMissing(frame, m)) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

StillRange findStillRange(const MarkerTrajectories& trial) {
  require(trial.frameCount() > 0 && trial.markerCount() > 0,
          ErrorCode::kInputMarkers,
          "the static trial has no frames or no markers");
  const SwaySums sums(trial);
  int first = 0;
  int last = trial.frameCount() - 1;
  StillRange still;
  still.sway = still.whole_sway = sums.calcSway(first, last);
  require(
      seesAnything(trial), ErrorCode::kInputMarkers, "no marker of the static trial is ever seen");
  if (!(still.whole_sway <= kStillSway)) {
    int end = 0;
    for (int begin = 0; begin < trial.frameCount(); ++begin) {
      while (end + 1 < trial.frameCount() &&
             trial.time[static_cast<std::size_t>(end)] <
                 trial.time[static_cast<std::size_t>(begin)] + kWindow) {
        ++end;
      }
      const double sway = sums.calcSway(begin, end);
      if (sway < still.sway) {
        still.sway = sway;
        first = begin;
        last = end;
      }
      if (end + 1 == trial.frameCount()) {
        break;
      }
    }
  }
  still.range = {trial.time[static_cast<std::size_t>(first)],
                 trial.time[static_cast<std::size_t>(last)]};
  still.frames = last - first + 1;
  if (still.whole_sway > kStillSway) {
    still.warnings.push_back(
        "the subject moves in the static trial (markers sway by " +
        formatFixed(1000 * still.whole_sway, 0) + " mm); the quietest part is used, " +
        formatFixed(still.range.start, 2) + " to " + formatFixed(still.range.end, 2) + " s (" +
        formatFixed(1000 * still.sway, 1) + " mm)");
  }
  if (still.frames < kFewFrames) {
    still.warnings.push_back("the static trial is short: " + std::to_string(still.frames) +
                             " frames do not average the noise of the markers");
  }
  const std::string gaps = listGaps(trial, first, last);
  if (!gaps.empty()) {
    still.warnings.push_back(
        "markers are missing in parts of the static trial, seen in share of its frames: " + gaps);
  }
  return still;
}

}  // namespace gaitmill

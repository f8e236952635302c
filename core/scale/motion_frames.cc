#include "core/scale/motion_frames.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/error.h"

namespace gaitmill {

namespace {

struct Candidate {
  int frame = -1;
  int visible = 0;
};

int countVisible(const MarkerTrajectories& trial, const std::vector<int>& columns, int frame) {
  return static_cast<int>(std::count_if(
      columns.begin(), columns.end(), [&](int column) { return !trial.isMissing(frame, column); }));
}

/// The best frame of [first, end).
Candidate findBest(const MarkerTrajectories& trial,
                   const std::vector<int>& columns,
                   int first,
                   int end) {
  Candidate best;
  const double middle = 0.5 * (first + end - 1);
  for (int frame = first; frame < end; ++frame) {
    const int visible = countVisible(trial, columns, frame);
    const bool closer = std::abs(frame - middle) < std::abs(best.frame - middle);
    if (visible > best.visible || (visible > 0 && visible == best.visible && closer)) {
      best = {frame, visible};
    }
  }
  return best;
}

std::vector<int> findColumns(const MarkerTrajectories& trial,
                             const std::vector<std::string>& markers) {
  std::vector<int> columns;
  for (const std::string& marker : markers) {
    const std::optional<int> column = trial.findMarker(marker);
    require(
        column.has_value(), ErrorCode::kInputMarkers, "marker '" + marker + "' is not measured");
    columns.push_back(*column);
  }
  return columns;
}

}  // namespace

std::vector<int> chooseFrames(const MarkerTrajectories& trial,
                              const std::vector<std::string>& markers,
                              const TimeRange& range,
                              int count) {
  const std::vector<int> columns = findColumns(trial, markers);
  const auto begin = std::lower_bound(trial.time.begin(), trial.time.end(), range.start);
  const auto end = std::upper_bound(begin, trial.time.end(), range.end);
  require(begin != end,
          ErrorCode::kInputTimeRange,
          "no frame of the motion lies in the time range",
          {{}, 0, 0, "time_range_s"});
  const int first = static_cast<int>(std::distance(trial.time.begin(), begin));
  const int frames = static_cast<int>(std::distance(begin, end));
  const int parts = std::min(count, frames);
  std::vector<Candidate> candidates;
  int most = 0;
  for (int part = 0; part < parts; ++part) {
    // In 64 bits: a long recording times the number of parts.
    const auto edge = [&](int i) {
      return first + static_cast<int>(static_cast<long long>(frames) * i / parts);
    };
    candidates.push_back(findBest(trial, columns, edge(part), edge(part + 1)));
    most = std::max(most, candidates.back().visible);
  }
  require(most > 0, ErrorCode::kInputMarkers, "no weighted marker is visible in any frame");
  std::vector<int> chosen;
  for (const Candidate& candidate : candidates) {
    if (2 * candidate.visible >= most) {
      chosen.push_back(candidate.frame);
    }
  }
  return chosen;
}

Eigen::Matrix3Xd readMarkers(const MarkerTrajectories& trial,
                             const std::vector<std::string>& markers,
                             int frame) {
  const std::vector<int> columns = findColumns(trial, markers);
  Eigen::Matrix3Xd measured(3, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t m = 0; m < columns.size(); ++m) {
    measured.col(static_cast<Eigen::Index>(m)) = trial.position(frame, columns[m]);
  }
  return measured;
}

}  // namespace gaitmill

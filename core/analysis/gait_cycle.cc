#include "core/analysis/gait_cycle.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace gaitmill {

namespace {

// Printed times carry eight decimals; a sample this close to the record's end is covered [s].
constexpr double kTimeSlack = 1e-7;

bool isCovered(double time, double first_time, double last_time) {
  return time >= first_time - kTimeSlack && time <= last_time + kTimeSlack;
}

int findSeam(const GaitCycle& cycle, double first_time, std::optional<int> seam_percent) {
  if (seam_percent) {
    return *seam_percent;
  }
  const double start = calcPercent(cycle, first_time + kTimeSlack);
  return start <= 0 ? 0 : static_cast<int>(std::min(100.0, std::ceil(start - 1e-3)));
}

void requireCycle(const GaitCycle& cycle) {
  require(cycle.end > cycle.start,
          ErrorCode::kInputTimeRange,
          "the second heel strike is not later than the first");
}

}  // namespace

double calcPercent(const GaitCycle& cycle, double time) {
  return 100.0 * (time - cycle.start) / (cycle.end - cycle.start);
}

double calcCycleTime(const GaitCycle& cycle, double percent) {
  return cycle.start + 0.01 * percent * (cycle.end - cycle.start);
}

std::vector<CycleSample> makeComparisonGrid(const GaitCycle& cycle,
                                            double first_time,
                                            double last_time,
                                            std::optional<int> seam_percent) {
  requireCycle(cycle);
  const int seam = findSeam(cycle, first_time, seam_percent);
  std::vector<CycleSample> grid;
  const auto addIfCovered = [&](int percent, int cycles_later) {
    const double time = calcCycleTime(cycle, percent + 100.0 * cycles_later);
    if (isCovered(time, first_time, last_time)) {
      grid.push_back({static_cast<double>(percent), time});
    }
  };
  for (int percent = seam; percent <= 100; ++percent) {
    addIfCovered(percent, 0);
  }
  for (int percent = 0; seam > 0 && percent <= seam; ++percent) {
    addIfCovered(percent, 1);
  }
  return grid;
}

}  // namespace gaitmill

#include "core/analysis/actuator_statistics.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace gaitmill {

std::vector<ActuatorStatistics> calcActuatorStatistics(const TimeSeries& forces,
                                                       const std::vector<std::string>& names) {
  require(
      forces.rowCount() > 0, ErrorCode::kTableNoRows, "table '" + forces.name + "' has no rows");
  std::vector<ActuatorStatistics> statistics;
  for (const std::string& name : names) {
    const auto column = forces.values.col(forces.getColumn(name));
    statistics.push_back({name,
                          column.cwiseAbs().maxCoeff(),
                          std::sqrt(column.squaredNorm() / static_cast<double>(column.size()))});
  }
  return statistics;
}

const ActuatorStatistics& findLargestPeak(const std::vector<ActuatorStatistics>& statistics) {
  require(!statistics.empty(), ErrorCode::kTableNoRows, "no actuator to choose from");
  return *std::max_element(statistics.begin(), statistics.end(), [](const auto& a, const auto& b) {
    return a.peak < b.peak;
  });
}

}  // namespace gaitmill

#include "core/analysis/moment_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"

namespace gaitmill {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
// Share of the moment that muscles must account for, and the floor under the moment where it
// crosses zero, as a share of its peak: the definition proposed in spec/paper_metrics.md C5.
constexpr double kMissingShare = 0.1;
constexpr double kFloorShare = 0.05;

int getMomentColumn(const TimeSeries& table, const std::string& coordinate) {
  const std::optional<int> column = table.findColumn(coordinate + "_moment");
  return column ? *column : table.getColumn(coordinate);
}

// Both curves on the same samples, in the paper's sign.
struct Curves {
  std::vector<CycleSample> grid;
  Eigen::VectorXd id;      // [N.m]
  Eigen::VectorXd muscle;  // [N.m]
};

Curves sampleCurves(const TimeSeries& inverse_dynamics,
                    const TimeSeries& muscle_moments,
                    const ComparedMoment& moment,
                    const GaitCycle& cycle,
                    std::optional<int> seam_percent) {
  const int id_column = getMomentColumn(inverse_dynamics, moment.coordinate);
  const int muscle_column = getMomentColumn(muscle_moments, moment.coordinate);
  Curves curves;
  curves.grid =
      makeComparisonGrid(cycle,
                         std::max(inverse_dynamics.time.front(), muscle_moments.time.front()),
                         std::min(inverse_dynamics.time.back(), muscle_moments.time.back()),
                         seam_percent);
  const auto count = static_cast<Eigen::Index>(curves.grid.size());
  curves.id.resize(count);
  curves.muscle.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double time = curves.grid[static_cast<std::size_t>(i)].time;
    curves.id[i] = moment.sign * inverse_dynamics.interpolate(time)[id_column];
    curves.muscle[i] = moment.sign * muscle_moments.interpolate(time)[muscle_column];
  }
  return curves;
}

// The 90 % rule of C5, instant by instant.
void judgeShares(const Curves& curves, MomentComparison& result) {
  const double floor = kFloorShare * curves.id.cwiseAbs().maxCoeff();
  int satisfied = 0;
  result.worst_share = -1;
  for (Eigen::Index i = 0; i < curves.id.size(); ++i) {
    const double base = std::max(std::abs(curves.id[i]), floor);
    const double share = std::abs(curves.id[i] - curves.muscle[i]) / base;
    satisfied += share <= kMissingShare ? 1 : 0;
    if (share > result.worst_share) {
      result.worst_share = share;
      result.worst_percent = curves.grid[static_cast<std::size_t>(i)].percent;
    }
  }
  result.fraction_at_90_percent = satisfied / static_cast<double>(curves.id.size());
}

}  // namespace

const std::vector<ComparedMoment>& paperMoments() {
  static const std::vector<ComparedMoment> moments = {
      {"hip_flexion_r", 1.0}, {"knee_angle_r", -1.0}, {"ankle_angle_r", -1.0}};
  return moments;
}

MomentComparison compareMoments(const TimeSeries& inverse_dynamics,
                                const TimeSeries& muscle_moments,
                                const ComparedMoment& moment,
                                const GaitCycle& cycle,
                                std::optional<int> seam_percent) {
  for (const TimeSeries* table : {&inverse_dynamics, &muscle_moments}) {
    require(
        table->rowCount() > 0, ErrorCode::kTableNoRows, "table '" + table->name + "' has no rows");
  }
  const Curves curves = sampleCurves(inverse_dynamics, muscle_moments, moment, cycle, seam_percent);
  MomentComparison result{moment.coordinate,
                          static_cast<int>(curves.grid.size()),
                          kNan,
                          kNan,
                          kNan,
                          kNan,
                          kNan,
                          kNan,
                          kNan,
                          kNan};
  if (curves.grid.empty()) {
    return result;
  }
  const Eigen::VectorXd difference = curves.id - curves.muscle;
  result.rmse = std::sqrt(difference.squaredNorm() / static_cast<double>(difference.size()));
  result.peak = curves.id.maxCoeff();
  result.rmse_percent_of_peak = 100.0 * result.rmse / result.peak;
  result.peak_difference = difference.cwiseAbs().maxCoeff();
  result.peak_difference_percent_of_peak = 100.0 * result.peak_difference / result.peak;
  judgeShares(curves, result);
  return result;
}

double calcFractionAt90Percent(const std::vector<MomentComparison>& moments) {
  double satisfied = 0;
  int instants = 0;
  for (const MomentComparison& moment : moments) {
    if (moment.instants > 0) {
      satisfied += moment.fraction_at_90_percent * moment.instants;
      instants += moment.instants;
    }
  }
  return instants > 0 ? satisfied / instants : kNan;
}

}  // namespace gaitmill

#include "core/analysis/work.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "core/base/error.h"

namespace gaitmill {

namespace {

// A record may end an integration step before the strike.
constexpr double kTimeSlack = 1e-3;  // [s]
constexpr int kColumnsPerMuscle = 5;

TimeSeries makeTable(const std::vector<std::string>& muscles, std::vector<double> time) {
  TimeSeries table = makeTimeSeries("muscle_work", {}, std::move(time));
  for (const std::string& muscle : muscles) {
    for (const char* part : {"_fiber_positive_work",
                             "_fiber_negative_work",
                             "_tendon_positive_work",
                             "_tendon_negative_work",
                             "_net_work"}) {
      table.labels.push_back(muscle + part);
    }
  }
  table.units.assign(table.labels.size(), "J");
  table.values.resize(table.rowCount(), table.columnCount());
  return table;
}

}  // namespace

TimeSeries cutInterval(const TimeSeries& table, double start, double end) {
  require(table.rowCount() > 0, ErrorCode::kTableNoRows, "table '" + table.name + "' has no rows");
  std::vector<double> time = {start};
  std::copy_if(table.time.begin(), table.time.end(), std::back_inserter(time), [&](double t) {
    return t > start && t < end;
  });
  time.push_back(end);
  TimeSeries cut = makeTimeSeries(table.name, table.labels, std::move(time));
  cut.units = table.units;
  for (int row = 0; row < cut.rowCount(); ++row) {
    cut.values.row(row) = table.interpolate(cut.time[static_cast<std::size_t>(row)]).transpose();
  }
  return cut;
}

SignedWork integratePower(const TimeSeries& powers, int column) {
  SignedWork work;
  for (int row = 0; row + 1 < powers.rowCount(); ++row) {
    const auto i = static_cast<std::size_t>(row);
    const double a = powers.values(row, column);
    const double b = powers.values(row + 1, column);
    const double half = 0.5 * (powers.time[i + 1] - powers.time[i]);
    if (a * b >= 0) {
      (a + b > 0 ? work.positive : work.negative) += half * (a + b);
      continue;
    }
    // The line crosses zero: a triangle on either side.
    const double share = a / (a - b);
    (a > 0 ? work.positive : work.negative) += half * share * a;
    (b > 0 ? work.positive : work.negative) += half * (1 - share) * b;
  }
  return work;
}

std::optional<GaitCycle> findCoveredCycle(const GaitCycle& cycle,
                                          double first_time,
                                          double last_time) {
  const double start = std::max(cycle.start, first_time);
  const double end = start + (cycle.end - cycle.start);
  if (start >= cycle.end || end > last_time + kTimeSlack) {
    return std::nullopt;
  }
  return GaitCycle{start, end};
}

TimeSeries calcMuscleWork(const MuscleAnalysis& muscles, const std::vector<GaitCycle>& cycles) {
  const std::vector<double>& time = muscles.muscle_powers.time;
  std::vector<GaitCycle> covered;
  std::vector<double> starts;
  for (const GaitCycle& cycle : cycles) {
    if (const auto stretch = findCoveredCycle(cycle, time.front(), time.back())) {
      covered.push_back(*stretch);
      starts.push_back(cycle.start);
    }
  }
  TimeSeries fiber_powers = muscles.fiber_active_powers;
  fiber_powers.values += muscles.fiber_passive_powers.values;
  TimeSeries table = makeTable(fiber_powers.labels, std::move(starts));
  for (int row = 0; row < table.rowCount(); ++row) {
    const GaitCycle& cycle = covered[static_cast<std::size_t>(row)];
    const TimeSeries fibers = cutInterval(fiber_powers, cycle.start, cycle.end);
    const TimeSeries tendons = cutInterval(muscles.tendon_powers, cycle.start, cycle.end);
    const TimeSeries wholes = cutInterval(muscles.muscle_powers, cycle.start, cycle.end);
    for (int muscle = 0; muscle < fibers.columnCount(); ++muscle) {
      const SignedWork fiber = integratePower(fibers, muscle);
      const SignedWork tendon = integratePower(tendons, muscle);
      const SignedWork whole = integratePower(wholes, muscle);
      table.values.row(row).segment<kColumnsPerMuscle>(Eigen::Index{kColumnsPerMuscle} * muscle)
          << fiber.positive,
          fiber.negative, tendon.positive, tendon.negative, whole.positive + whole.negative;
    }
  }
  return table;
}

}  // namespace gaitmill

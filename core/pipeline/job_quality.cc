#include <string>
#include <vector>

#include "core/pipeline/job.h"

namespace gaitmill {

namespace {

/// Names of the residuals, or of the reserves that are added to the muscles.
std::vector<std::string> pickNames(const std::vector<ActuatorSpec>& specs, bool residuals) {
  std::vector<std::string> names;
  for (const ActuatorSpec& spec : specs) {
    if (residuals == (spec.kind != ActuatorSpec::Kind::kCoordinate)) {
      names.push_back(spec.name);
    }
  }
  return names;
}

/// The pass whose motion inverse dynamics analyses; by default the last.
const RraPassResult& findReportedPass(const Job& job) {
  const auto count = static_cast<int>(job.rra->passes.size());
  const int asked = job.settings.id_pass;
  const int pass = asked >= 1 && asked <= count ? asked : count;
  return job.rra->passes[static_cast<std::size_t>(pass - 1)];
}

std::vector<MomentComparison> compareAllMoments(const Job& job) {
  std::vector<MomentComparison> moments;
  const TimeSeries& muscle = job.cmc->muscle_moment;
  // Without two strikes of one foot the simulated time stands in for the cycle.
  const GaitCycle cycle =
      findGaitCycle(job).value_or(GaitCycle{muscle.time.front(), muscle.time.back()});
  for (const ComparedMoment& moment : paperMoments()) {
    if (muscle.findColumn(moment.coordinate)) {
      moments.push_back(compareMoments(job.id->generalized_forces, muscle, moment, cycle));
    }
  }
  return moments;
}

}  // namespace

JobQuality calcQuality(const Job& job) {
  JobQuality quality;
  if (job.rra) {
    quality.rra_tracking = calcTrackingError(findReportedPass(job).tracking_errors);
  }
  if (job.cmc) {
    const std::vector<ActuatorSpec>& actuators = job.cmc->options.actuators;
    quality.cmc_tracking = calcTrackingError(job.cmc->tracking_error);
    quality.residuals = calcActuatorStatistics(job.cmc->actuator_force, pickNames(actuators, true));
    quality.reserves = calcActuatorStatistics(job.cmc->actuator_force, pickNames(actuators, false));
  }
  if (job.cmc && job.id) {
    quality.moments = compareAllMoments(job);
  }
  addChecks(job, quality);
  return quality;
}

std::optional<std::string> makeAcceptanceText(const Job& job, const JobQuality& quality) {
  const bool complete = quality.rra_tracking && quality.cmc_tracking &&
                        quality.moments.size() == paperMoments().size() &&
                        quality.residuals.size() == 6;
  if (!job.settings.paper_trial || !complete) {
    return std::nullopt;
  }
  const AcceptanceInput input{*quality.rra_tracking,
                              *quality.cmc_tracking,
                              quality.moments,
                              quality.residuals,
                              quality.reserves};
  return renderAcceptanceTable(makeAcceptanceTable(*job.settings.paper_trial, input));
}

}  // namespace gaitmill

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/model/model.h"
#include "core/pipeline/job.h"
#include "core/pipeline/job_emg.h"

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

/// The pass whose motion inverse dynamics analyses; by default the one that is kept.
const RraPassResult& findReportedPass(const Job& job) {
  const auto count = static_cast<int>(job.rra->passes.size());
  const int asked = job.settings.id_pass;
  if (asked < 1 || asked > count) {
    return job.rra->keptPass();
  }
  const RraPassResult& pass = job.rra->passes[static_cast<std::size_t>(asked - 1)];
  return pass.tracking_errors.rowCount() > 0 ? pass : job.rra->keptPass();
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

double findPeakReaction(const GroundReaction& reaction) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(reaction.time.size()));
  for (const ExternalForce& force : reaction.forces) {
    sum += force.force.row(1).transpose();
  }
  return sum.size() > 0 ? sum.maxCoeff() : std::numeric_limits<double>::quiet_NaN();
}

/// Mean over some fifty rows: it hardly moves between them.
double calcMassCenterHeight(const ModelSpec& spec, const TimeSeries& pose) {
  constexpr int kRows = 50;
  const Model model(spec);
  ModelState state(model);
  const int step = std::max(1, pose.rowCount() / kRows);
  double sum = 0;
  int count = 0;
  for (int row = 0; row < pose.rowCount(); row += step) {
    state.setPose(pose.values.row(row).transpose());
    sum += state.calcMassCenter().y();
    ++count;
  }
  return sum / count;
}

std::vector<std::string> muscleNames(const ModelSpec& model) {
  std::vector<std::string> names;
  for (const MuscleSpec& muscle : model.muscles) {
    names.push_back(muscle.name);
  }
  return names;
}

std::vector<FiberRange> calcFibers(const Job& job) {
  TimeSeries lengths = job.cmc->fiber_length;
  for (int column = 0; column < lengths.columnCount(); ++column) {
    const int muscle = job.adjusted.findMuscle(lengths.labels[static_cast<std::size_t>(column)]);
    check(muscle >= 0, "a fiber length belongs to no muscle");
    lengths.values.col(column) /=
        job.adjusted.muscles[static_cast<std::size_t>(muscle)].optimal_fiber_length;
  }
  TimeSeries active = job.cmc->tendon_force;
  active.values -= job.cmc->passive_fiber_force.values;
  return calcFiberRanges(lengths, active, kShortestFiber, kLongestFiber);
}

void addMotion(const Job& job, JobQuality& quality) {
  if (job.ik) {
    quality.markers = calcMarkerStatistics(job.ik->marker_errors, job.ik->weights);
  }
  if (job.rra) {
    const TimeSeries& forces = job.rra->keptPass().actuator_forces;
    quality.rra_tracking = calcTrackingError(findReportedPass(job).tracking_errors);
    quality.rra_residuals =
        calcActuatorStatistics(forces, pickNames(job.rra->options.actuators, true));
  }
}

void addStaticOptimization(const Job& job, JobQuality& quality) {
  const std::vector<ActuatorSpec> actuators =
      makeActuators(job.settings.so_actuators, job.adjusted);
  quality.so_residuals = calcActuatorStatistics(job.so->forces, pickNames(actuators, true));
  quality.so_reserves = calcActuatorStatistics(job.so->forces, pickNames(actuators, false));
  quality.so_saturations =
      calcSaturation(job.so->activations, muscleNames(job.adjusted), kFullExcitation);
  if (job.id) {
    quality.so_joint_reserves = calcJointReserves(
        quality.so_reserves, actuators, job.adjusted.joints, job.id->generalized_forces);
  }
}

void addMuscleControl(const Job& job, JobQuality& quality) {
  const CmcResult& cmc = *job.cmc;
  const std::vector<ActuatorSpec>& actuators = cmc.options.actuators;
  quality.cmc_tracking = calcTrackingError(cmc.tracking_error);
  quality.residuals = calcActuatorStatistics(cmc.actuator_force, pickNames(actuators, true));
  quality.reserves = calcActuatorStatistics(cmc.actuator_force, pickNames(actuators, false));
  quality.saturations = calcSaturation(cmc.excitation, muscleNames(job.adjusted), kFullExcitation);
  quality.fibers = calcFibers(job);
  quality.mass_center_height = calcMassCenterHeight(job.adjusted, cmc.pose);
  if (job.id) {
    quality.joint_reserves = calcJointReserves(
        quality.reserves, actuators, job.adjusted.joints, job.id->generalized_forces);
    quality.moments = compareAllMoments(job);
  }
}

}  // namespace

JobQuality calcQuality(const Job& job) {
  JobQuality quality;
  quality.peak_reaction = findPeakReaction(job.reaction);
  addMotion(job, quality);
  if (job.so) {
    addStaticOptimization(job, quality);
  }
  if (job.cmc) {
    addMuscleControl(job, quality);
  }
  quality.emg = compareEmgs(job);
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

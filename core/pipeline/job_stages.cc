#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/cmc/cmc_solver.h"
#include "core/id/id_solver.h"
#include "core/ik/ik_solver.h"
#include "core/math/events.h"
#include "core/math/natural_spline.h"
#include "core/math/table_filters.h"
#include "core/model/external_loads.h"
#include "core/model/free_coordinates.h"
#include "core/model/model.h"
#include "core/model/reference_motion.h"
#include "core/pipeline/job.h"
#include "core/pipeline/job_emg.h"
#include "core/pipeline/model_coordinates.h"
#include "core/rra/rra_solver.h"
#include "core/scale/motion_scale.h"
#include "core/scale/scale_solver.h"
#include "core/so/so_solver.h"

namespace gaitmill {

namespace {

/// Rows added by reflection before a motion is splined for tracking (spec/cmc.md 2).
constexpr int kPadRows = 60;

/// Processor seconds of this thread.
double readProcessorClock() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Progress makeProgress(Stage stage, const Job& job) {
  if (!job.events->progress) {
    return {};
  }
  return [stage, events = job.events](double fraction) {
    return events->progress(stage, fraction);
  };
}

void takeWarnings(const char* stage, const std::vector<std::string>& warnings, Job& job) {
  for (const std::string& warning : warnings) {
    job.warn(std::string(stage) + ": " + warning);
  }
}

void runScale(Job& job) {
  ScaleOptions options;
  options.marker_set = job.marker_set;
  options.subject_mass = job.input->mass;
  options.fiber_damping = job.settings.fiber_damping;
  if (scalesByMotion(*job.input, job.settings)) {
    MotionScaleOptions motion;
    motion.subject_height = job.input->height;
    motion.range = job.settings.ik_range;
    motion.warn_rms = job.settings.ik_warn_rms;
    job.scale = MotionScaleSolver(job.generic, options, motion)
                    .solve(job.markers, makeProgress(Stage::kScale, job));
  } else {
    job.scale = ScaleSolver(job.generic, options).solve(job.static_poses);
  }
  takeWarnings("scale", job.scale->warnings, job);
}

// Markers that drift, or whose names are in doubt, pull less.
void weighFaults(const Job& job, FitTasks& tasks) {
  for (MarkerWeight& task : tasks.markers) {
    const std::optional<int> marker = job.markers.findMarker(task.marker);
    if (marker && !job.marker_repair.weights.empty()) {
      task.weight *= job.marker_repair.weights[static_cast<std::size_t>(*marker)];
    }
  }
}

void runIk(Job& job) {
  IkOptions options;
  options.tasks = job.marker_set.ik;
  weighFaults(job, options.tasks);
  options.range = job.settings.ik_range;
  options.warn_rms = job.settings.ik_warn_rms;
  options.warn_max = job.settings.ik_warn_max;
  const Model model(job.scaled);
  IkSolver solver(model, options, job.markers.names);
  job.ik = solver.solve(job.markers, makeProgress(Stage::kIk, job));
  takeWarnings("ik", job.ik->warnings, job);
}

/// What a stage is asked for, by its own settings or by default.
TimeRange findAskedRange(Stage stage, const TimeRange& stated, const Job& job) {
  const bool is_stated = std::isfinite(stated.start) || std::isfinite(stated.end);
  return is_stated ? stated : findDefaultRange(stage, job);
}

/// The interval in which kinematics and forces both exist, within what was asked.
TimeRange findCommonRange(const TimeRange& asked,
                          const TimeSeries& motion,
                          const GroundReaction& reaction) {
  TimeRange range;
  range.start = std::max(asked.start, motion.time.front());
  range.end = std::min(asked.end, motion.time.back());
  if (!reaction.time.empty()) {
    range.start = std::max(range.start, reaction.time.front());
    range.end = std::min(range.end, reaction.time.back());
  }
  require(range.start < range.end,
          ErrorCode::kInputTimeRange,
          "kinematics (" + std::to_string(motion.time.front()) + " to " +
              std::to_string(motion.time.back()) +
              " s) and forces have no time in common with the range asked for",
          {{}, 0, 0, "time_range_s"});
  return range;
}

/// Whether the body leaves the ground: no step of a runner lasts as long as this, and a walker's
/// steps overlap, so that a plate or two bear him for longer.
bool isRunning(const GroundReaction& reaction) {
  constexpr double kLongestRunningStep = 0.45;  // [s]
  Eigen::VectorXd vertical = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(reaction.time.size()));
  for (const ExternalForce& force : reaction.forces) {
    vertical += force.force.row(1).transpose();
  }
  double longest = 0;
  for (const Contact& contact : findContacts(reaction.time, vertical)) {
    if (contact.has_strike && contact.has_toe_off) {
      longest = std::max(longest, contact.toe_off - contact.strike);
    }
  }
  return longest > 0 && longest < kLongestRunningStep;
}

/// Cutoffs of the published trials (spec/rra.md 5): a runner's foot strike is over in 50 ms.
void setCutoff(const Job& job, RraOptions& options) {
  constexpr double kWalkingCutoff = 6;   // [Hz]
  constexpr double kRunningCutoff = 15;  // [Hz]
  const RraSettings& settings = job.settings.rra;
  if (!settings.automatic_cutoff) {
    options.lowpass_cutoff = settings.lowpass_cutoff;
    options.lowpass_reason = "as the settings state";
    return;
  }
  const bool running = job.gait.kind == GaitKind::kUnknown ? isRunning(job.reaction)
                                                           : job.gait.kind == GaitKind::kRunning;
  options.lowpass_cutoff = running ? kRunningCutoff : kWalkingCutoff;
  options.lowpass_reason = running ? "running: steps are short and the body leaves the ground"
                                   : "walking: no flight between steps";
}

RraOptions makeRraOptions(const Job& job) {
  const RraSettings& settings = job.settings.rra;
  RraOptions options;
  options.strategy = settings.strategy;
  setCutoff(job, options);
  options.actuators = makeActuators(settings.actuators, job.scaled);
  options.adjusted_body = settings.adjusted_body == RraOptions().adjusted_body
                              ? findTrunk(settings.adjusted_body, job.scaled)
                              : settings.adjusted_body;
  options.inertia_scaling = settings.inertia;
  options.max_passes = settings.max_passes;
  options.mass_tolerance = settings.mass_tolerance;
  options.mass_center_tolerance = settings.center_tolerance;
  for (const RraSettings::Pass& pass : settings.passes) {
    const TimeRange asked = findAskedRange(Stage::kRra, pass.range.value_or(settings.range), job);
    const TimeRange range = findCommonRange(asked, job.measured_coordinates, job.reaction);
    options.passes.push_back({range.start, range.end, fitTasks(pass, job.scaled)});
  }
  return options;
}

void runRra(Job& job) {
  job.rra = solveRra(job.scaled,
                     job.measured_coordinates,
                     job.reaction,
                     makeRraOptions(job),
                     makeProgress(Stage::kRra, job));
  takeWarnings("rra", job.rra->warnings, job);
}

bool hasMusclesOf(const ModelSpec& generic, const ModelSpec& model) {
  return std::all_of(model.muscles.begin(), model.muscles.end(), [&](const MuscleSpec& muscle) {
    return generic.findMuscle(muscle.name) >= 0;
  });
}

/// Strength belongs behind residual reduction, which settles the mass (spec/scale.md 5). A model
/// that comes in later is taken as it is.
void adjustMuscles(Job& job) {
  const PipelineSettings& settings = job.settings;
  if (settings.strength_law != StrengthLaw::kNone && !hasMusclesOf(job.generic, job.adjusted)) {
    job.warn(
        "strength: the model came scaled and its generic form is not known, so that the "
        "strength of its muscles stays as it is");
  } else if (settings.strength_law != StrengthLaw::kNone) {
    const BodySize subject{job.adjusted.calcTotalMass(),
                           settings.strength_height.value_or(job.input->height)};
    scaleStrength(job.generic, settings.strength_law, subject, job.adjusted);
  }
  for (MuscleSpec& muscle : job.adjusted.muscles) {
    muscle.max_contraction_velocity =
        settings.max_contraction_velocity.value_or(muscle.max_contraction_velocity);
  }
}

/// The kinematics of the pass that inverse dynamics analyses.
const TimeSeries& findAnalysedMotion(const Job& job) {
  const int pass = job.settings.id_pass;
  if (!job.rra || pass < 1 || pass > static_cast<int>(job.rra->passes.size())) {
    return job.motion;
  }
  const TimeSeries& coordinates = job.rra->passes[static_cast<std::size_t>(pass - 1)].coordinates;
  return coordinates.rowCount() > 0 ? coordinates : job.motion;
}

void runId(Job& job) {
  const Model model(job.adjusted);
  const ExternalLoads loads(model, job.reaction);
  IdOptions options = job.settings.id;
  // The forces of a motion out of residual reduction are known all along.
  if (!job.rra) {
    const TimeRange asked = findAskedRange(Stage::kId, {options.start_time, options.end_time}, job);
    options.start_time = asked.start;
    options.end_time = asked.end;
  }
  IdSolver solver(model, options);
  job.id = solver.solve(findAnalysedMotion(job), &loads, makeProgress(Stage::kId, job));
}

/// The motion on a uniform grid: residual reduction leaves rows at the integrator's own steps.
TimeSeries resampleUniformly(const TimeSeries& motion, const TimeRange& range, double step) {
  const NaturalSpline spline(motion.time, motion.values, 5);
  std::vector<double> time;
  const int rows = static_cast<int>(std::floor((range.end - range.start) / step + 1e-6)) + 1;
  for (int i = 0; i < rows; ++i) {
    time.push_back(range.start + i * step);
  }
  TimeSeries resampled = makeTimeSeries(motion.name, motion.labels, time);
  resampled.units = motion.units;
  Eigen::VectorXd row(motion.columnCount());
  for (int i = 0; i < rows; ++i) {
    spline.evaluate(time[static_cast<std::size_t>(i)], row);
    resampled.values.row(i) = row.transpose();
  }
  return resampled;
}

void runSo(Job& job) {
  // Ten spline rows per reported row keep the accelerations of the 1 ms kinematics.
  constexpr int kRowsPerInterval = 10;
  const Model model(job.adjusted);
  const ExternalLoads loads(model, job.reaction);
  SoOptions options = job.settings.so;
  options.actuators = makeActuators(job.settings.so_actuators, job.adjusted);
  options.range = findAskedRange(Stage::kSo, options.range, job);
  const TimeRange range = findCommonRange(options.range, job.motion, job.reaction);
  TimeSeries motion = job.motion;
  if (job.settings.so_interval > 0) {
    motion = resampleUniformly(motion, range, job.settings.so_interval / kRowsPerInterval);
    options.row_interval = kRowsPerInterval;
    options.range = {};
  }
  SoSolver solver(model, options);
  job.so = solver.solve(motion, loads, makeProgress(Stage::kSo, job));
  takeWarnings("so", job.so->warnings, job);
}

void warnInfeasible(Job& job) {
  for (const InfeasibleWindow& window : job.cmc->infeasible_windows) {
    std::string sentence = "cmc: the actuators cannot follow the motion in the window at " +
                           formatFixed(window.time, 3) + " s; missing";
    for (const InfeasibleWindow::Missing& missing : window.missing) {
      sentence += " " + missing.coordinate + " " + formatFixed(missing.force, 2);
    }
    job.warn(sentence);
  }
}

void runCmc(Job& job) {
  const Model model(job.adjusted);
  const ExternalLoads loads(model, job.reaction);
  const FreeCoordinates free(model);
  const ReferenceMotion reference(model, free, padOdd(job.motion, kPadRows));
  CmcOptions options = job.settings.cmc;
  const TimeRange range = findCommonRange(
      findAskedRange(Stage::kCmc, job.settings.cmc_range, job), job.motion, job.reaction);
  options.start_time = range.start;
  // The reference ends one integration row early where residual reduction made it; what was asked
  // for counts as long as the padded reference covers it.
  options.end_time = std::isfinite(job.settings.cmc_range.end)
                         ? std::min(job.settings.cmc_range.end, range.end + options.window)
                         : range.end;
  options.actuators = makeActuators(job.settings.cmc_actuators, job.adjusted);
  job.cmc = solveCmc(model, reference, loads, options, makeProgress(Stage::kCmc, job));
  warnInfeasible(job);
  if (job.cmc->stop == CmcStop::kDiverged) {
    job.warn("cmc: the simulation ran away from the motion and ends at " +
             formatFixed(job.cmc->pose.time.back(), 3) + " s; its last rows mean nothing");
  }
}

void runStageBody(Stage stage, Job& job) {
  switch (stage) {
    case Stage::kScale:
      runScale(job);
      break;
    case Stage::kIk:
      runIk(job);
      break;
    case Stage::kRra:
      runRra(job);
      break;
    case Stage::kId:
      runId(job);
      break;
    case Stage::kSo:
      runSo(job);
      break;
    case Stage::kCmc:
      runCmc(job);
      break;
  }
}

/// The last stage that can change the model before muscles matter.
bool settlesModel(Stage stage, const PipelineSettings& settings) {
  return settings.runs(Stage::kRra) ? stage == Stage::kRra : stage == Stage::kScale;
}

}  // namespace

void takeOver(Stage stage, Job& job) {
  if (stage == Stage::kScale) {
    job.scaled = job.scale->model;
    job.adjusted = job.scaled;
  } else if (stage == Stage::kIk) {
    job.measured_coordinates = job.ik->coordinates;
    job.motion = job.measured_coordinates;
  } else if (stage == Stage::kRra) {
    job.adjusted = job.rra->keptPass().adjusted_model;
    job.motion = job.rra->keptPass().coordinates;
  }
  if (settlesModel(stage, job.settings)) {
    adjustMuscles(job);
  }
  analyze(stage, job);
}

void runStage(Stage stage, Job& job) {
  const double before = readProcessorClock();
  try {
    reportProgress(makeProgress(stage, job), 0.0);
    runStageBody(stage, job);
    takeOver(stage, job);
    warnOfEmg(stage, job);
    reportProgress(makeProgress(stage, job), 1.0);
  } catch (Error& error) {
    Where where;
    where.stage = stageName(stage);
    error.completeWhere(where);
    throw;
  }
  job.seconds[static_cast<std::size_t>(stage)] = std::max(1e-9, readProcessorClock() - before);
}

}  // namespace gaitmill

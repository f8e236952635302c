#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/grf_reader.h"
#include "core/io/osim_reader.h"
#include "core/math/filters.h"
#include "core/pipeline/checkpoint.h"
#include "core/pipeline/intake.h"
#include "core/pipeline/job.h"
#include "core/pipeline/job_emg.h"
#include "core/pipeline/model_coordinates.h"

namespace gaitmill {

void Job::warn(const std::string& sentence) {
  warnings.push_back(sentence);
  if (events->warn && !quiet) {
    events->warn(sentence);
  }
}

namespace {

void needFile(const std::optional<InputFile>& file, const char* role, const char* reason) {
  require(file.has_value(),
          ErrorCode::kInputMissing,
          std::string("a file is missing: ") + role + ", " + reason,
          {{}, 0, 0, role});
}

void needPositive(double value, const char* field, const char* unit) {
  require(std::isfinite(value) && value > 0,
          ErrorCode::kInputValue,
          std::string("expected a positive number of ") + unit + ", found " + std::to_string(value),
          {{}, 0, 0, field});
}

ModelSpec openModel(const InputFile& file, Job& job) {
  std::vector<std::string> warnings;
  ModelSpec model = readOsim(file.bytes, file.name, &warnings);
  for (const std::string& warning : warnings) {
    job.warn(file.name + ": " + warning);
  }
  return model;
}

/// Force and moment about the ground origin through the critically damped filter. The point then is
/// the origin and the torque the moment: filtering a centre of pressure is meaningless off the
/// plate.
void filterForces(double cutoff, double threshold, GroundReaction& reaction) {
  const double rate = static_cast<double>(reaction.time.size() - 1) /
                      (reaction.time.back() - reaction.time.front());
  for (ExternalForce& force : reaction.forces) {
    const int n = static_cast<int>(force.force.cols());
    RowMatrix columns = RowMatrix::Zero(n, 6);
    for (int i = 0; i < n; ++i) {
      const Eigen::Vector3d F = force.force.col(i);
      const Eigen::Vector3d T = force.torque.col(i);
      if (!F.isZero(0.0) || !T.isZero(0.0)) {
        const Eigen::Vector3d p = force.point.col(i);
        columns.row(i) << F.transpose(), (p.cross(F) + T).transpose();
      }
    }
    filterCriticallyDamped(2, cutoff, rate, EdgeTreatment::kReflected, columns);
    for (int i = 0; i < n; ++i) {
      const double loaded = std::abs(columns(i, 1)) >= threshold ? 1.0 : 0.0;
      force.force.col(i) = loaded * columns.row(i).head<3>().transpose();
      force.torque.col(i) = loaded * columns.row(i).tail<3>().transpose();
      force.point.col(i).setZero();
    }
  }
}

void openForces(Intake& intake, Job& job) {
  const InputFile& file = *findForceFile(*job.input);
  ForceReading reading = intake.readForces(file);
  GrfOptions options = job.settings.forces.reading;
  options.unnamed = UnnamedPlates::kKeep;
  std::vector<std::string> warnings;
  const GroundReaction plates = selectForces(std::move(reading.plates),
                                             reading.feet,
                                             options,
                                             reading.table ? &*reading.table : nullptr,
                                             &warnings);
  for (const std::string& warning : warnings) {
    job.warn(file.name + ": " + warning);
  }
  takeFeet(plates, job);
  if (job.settings.forces.lowpass_cutoff) {
    filterForces(
        *job.settings.forces.lowpass_cutoff, job.settings.forces.reading.threshold, job.reaction);
  }
}

/// Static optimization and computed muscle control need something that moves every joint.
void completeModel(ModelSpec& model, Job& job) {
  std::string names;
  for (const std::string& coordinate : addTorqueActuators(model)) {
    names += (names.empty() ? "" : ", ") + coordinate;
  }
  if (!names.empty()) {
    job.warn("model: neither muscles nor actuators move " + names +
             "; torque actuators were added there");
  }
}

void openModels(Job& job) {
  const std::string own = job.models_folder + "/rajagopal2016/rajagopal2016.osim";
  const bool scales = job.settings.runs(Stage::kScale);
  job.generic = readOsim(readFile(own), own);
  if (job.input->model && scales) {
    job.generic = openModel(*job.input->model, job);
  }
  if (!scales) {
    job.scaled = openModel(*job.input->model, job);
    completeModel(job.scaled, job);
    job.adjusted = job.scaled;
  } else {
    completeModel(job.generic, job);
  }
}

void openMotion(Intake& intake, Job& job) {
  const bool measured = job.settings.runs(Stage::kIk);
  if (measured || scalesByMotion(*job.input, job.settings)) {
    MarkerReading reading = intake.readMovement(*job.input->markers);
    job.markers = std::move(reading.markers);
    job.marker_repair = std::move(reading.repair);
  }
  if (measured || job.settings.last <= Stage::kIk) {
    return;
  }
  const InputFile& file = *job.input->coordinates;
  std::vector<std::string> ignored;
  job.measured_coordinates =
      intake.readCoordinates(file, job.scaled.joints.empty() ? job.generic : job.scaled, ignored);
  for (const std::string& label : ignored) {
    job.warn(file.name + ": column '" + label + "' is no coordinate of the model and is ignored");
  }
  job.motion = job.measured_coordinates;
}

void openStaticPoses(Intake& intake, Job& job) {
  job.static_poses.push_back(intake.readStatic(*job.input->static_markers, "static").markers);
  if (job.input->static_markers_2) {
    job.static_poses.push_back(intake.readStatic(*job.input->static_markers_2, "static2").markers);
  }
}

bool needsForces(const PipelineSettings& settings) {
  return settings.last >= Stage::kRra;
}

}  // namespace

bool scalesByMotion(const TrialInput& input, const PipelineSettings& settings) {
  return settings.runs(Stage::kScale) &&
         (settings.scale_method == ScaleMethod::kMotion ||
          (settings.scale_method == ScaleMethod::kAuto && !input.static_markers));
}

void checkParts(const TrialInput& input, const PipelineSettings& settings) {
  if (settings.runs(Stage::kScale)) {
    needPositive(input.mass, "mass", "kilograms");
    if (scalesByMotion(input, settings)) {
      needFile(input.markers, "markers", "scaling without a static trial fits the movement");
      needPositive(input.height, "height", "metres");
    } else {
      needFile(input.static_markers, "static", "scaling by marker distances measures it");
    }
  } else {
    needFile(input.model, "model", "a scaled model is needed where scaling is not run");
  }
  const bool adjusts = settings.runs(Stage::kRra) || settings.runs(Stage::kScale);
  if (adjusts && settings.strength_law != StrengthLaw::kNone && settings.last >= Stage::kSo) {
    needPositive(input.mass, "mass", "kilograms");
    needPositive(settings.strength_height.value_or(input.height), "height", "metres");
  }
  if (settings.runs(Stage::kIk)) {
    needFile(input.markers, "markers", "inverse kinematics needs the movement's markers");
  } else if (settings.last > Stage::kIk) {
    needFile(
        input.coordinates, "coordinates", "they are needed where inverse kinematics is not run");
  }
  if (needsForces(settings)) {
    require(findForceFile(input) != nullptr,
            ErrorCode::kInputMissing,
            "a file is missing: grf, the dynamics stages need the ground reactions; without forces "
            "only scaling and inverse kinematics can run: set stages.last to \"ik\"",
            {{}, 0, 0, "grf"});
  }
}

Job openJob(const TrialInput& input,
            const InputFile& settings,
            const std::string& models_folder,
            const PipelineEvents& events,
            bool resumed) {
  Job job;
  job.quiet = resumed;
  job.input = &input;
  job.events = &events;
  job.models_folder = models_folder;
  job.settings = readSettings(settings);
  job.fingerprint = calcFingerprint(input, settings);
  checkParts(input, job.settings);
  openModels(job);
  // The movement first: its laboratory frame holds for the other files.
  Intake intake(job.settings);
  openMotion(intake, job);
  if (job.settings.runs(Stage::kScale) && !scalesByMotion(input, job.settings)) {
    openStaticPoses(intake, job);
  }
  if (needsForces(job.settings)) {
    openForces(intake, job);
  } else {
    takeFeet({}, job);
  }
  for (const std::string& warning : intake.warnings()) {
    job.warn(warning);
  }
  job.decisions.insert(job.decisions.begin(), intake.decisions().begin(), intake.decisions().end());
  resolveMarkers(job);
  openEmg(job);
  job.quiet = false;
  return job;
}

}  // namespace gaitmill

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/grf_reader.h"
#include "core/io/osim_reader.h"
#include "core/io/table_reader.h"
#include "core/io/trc_reader.h"
#include "core/math/filters.h"
#include "core/pipeline/job.h"

namespace gaitmill {

void Job::warn(const std::string& sentence) {
  warnings.push_back(sentence);
  if (events->warn) {
    events->warn(sentence);
  }
}

namespace {

const InputFile& needFile(const std::optional<InputFile>& file,
                          const char* role,
                          const char* reason) {
  require(file.has_value(),
          ErrorCode::kInputMissing,
          std::string("a file is missing: ") + role + ", " + reason,
          {{}, 0, 0, role});
  return *file;
}

void needPositive(double value, const char* field, const char* unit) {
  require(std::isfinite(value) && value > 0,
          ErrorCode::kInputValue,
          std::string("expected a positive number of ") + unit + ", found " + std::to_string(value),
          {{}, 0, 0, field});
}

MarkerTrajectories openMarkers(const InputFile& file, Job& job) {
  TrcFile trc = readTrc(file.bytes, file.name, job.settings.trc);
  for (const std::string& warning : trc.warnings) {
    job.warn(file.name + ": " + warning);
  }
  return std::move(trc.markers);
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

void openForces(Job& job) {
  const InputFile& file =
      needFile(job.input->ground_reaction, "grf", "the dynamics stages need the ground reactions");
  const TableFile table = readTable(file.bytes, file.name);
  for (const std::string& warning : table.warnings) {
    job.warn(file.name + ": " + warning);
  }
  job.reaction = readGroundReaction(table, job.settings.forces.reading);
  if (job.settings.forces.lowpass_cutoff) {
    filterForces(
        *job.settings.forces.lowpass_cutoff, job.settings.forces.reading.threshold, job.reaction);
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
    job.scaled = openModel(
        needFile(job.input->model, "model", "a scaled model is needed where scaling is not run"),
        job);
    job.adjusted = job.scaled;
  }
}

void openMotion(Job& job) {
  const bool measured = job.settings.runs(Stage::kIk);
  if (measured) {
    job.markers = openMarkers(
        needFile(job.input->markers, "markers", "inverse kinematics needs the movement's markers"),
        job);
    return;
  }
  if (job.settings.last <= Stage::kIk) {
    return;
  }
  const InputFile& file = needFile(
      job.input->coordinates, "coordinates", "they are needed where inverse kinematics is not run");
  std::vector<std::string> ignored;
  job.measured_coordinates = toCoordinates(readTable(file.bytes, file.name),
                                           job.scaled.joints.empty() ? job.generic : job.scaled,
                                           &ignored);
  for (const std::string& label : ignored) {
    job.warn(file.name + ": column '" + label + "' is no coordinate of the model and is ignored");
  }
  job.motion = job.measured_coordinates;
}

}  // namespace

Job openJob(const TrialInput& input,
            const InputFile& settings,
            const std::string& models_folder,
            const PipelineEvents& events) {
  Job job;
  job.input = &input;
  job.events = &events;
  job.models_folder = models_folder;
  job.settings = readSettings(settings);
  job.settings_json = settings.bytes;
  openModels(job);
  if (job.settings.runs(Stage::kScale)) {
    needPositive(input.mass, "mass", "kilograms");
    job.static_poses.push_back(openMarkers(
        needFile(input.static_markers, "static", "scaling measures a static trial"), job));
    if (input.static_markers_2) {
      job.static_poses.push_back(openMarkers(*input.static_markers_2, job));
    }
  }
  const bool adjusts = job.settings.runs(Stage::kRra) || job.settings.runs(Stage::kScale);
  if (adjusts && job.settings.strength_law != StrengthLaw::kNone &&
      job.settings.last >= Stage::kSo) {
    needPositive(input.mass, "mass", "kilograms");
    needPositive(job.settings.strength_height.value_or(input.height), "height", "metres");
  }
  openMotion(job);
  if (job.settings.last >= Stage::kRra) {
    openForces(job);
  }
  return job;
}

}  // namespace gaitmill

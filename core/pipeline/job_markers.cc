#include <set>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/pipeline/job.h"
#include "core/pipeline/marker_names_json.h"
#include "core/pipeline/marker_set_json.h"

namespace gaitmill {

namespace {

/// Markers of the static trials and of the movement, each name once.
std::vector<std::string> listMeasured(const Job& job) {
  std::vector<std::string> names;
  std::set<std::string> seen;
  const auto add = [&](const MarkerTrajectories& markers) {
    for (const std::string& name : markers.names) {
      if (seen.insert(name).second) {
        names.push_back(name);
      }
    }
  };
  for (const MarkerTrajectories& pose : job.static_poses) {
    add(pose);
  }
  add(job.markers);
  return names;
}

/// What the trial's own part says, and over it what the settings say.
MarkerOverrides findOverrides(const Job& job) {
  MarkerOverrides stated;
  if (job.input->marker_names) {
    stated = readMarkerNames(*job.input->marker_names);
  }
  for (const auto& [measured, landmark] : job.settings.marker_names) {
    stated[measured] = landmark;
  }
  return stated;
}

}  // namespace

MarkerSetSpec openMarkerSet(const TrialInput& input,
                            const PipelineSettings& settings,
                            const std::string& models_folder) {
  if (input.marker_set) {
    return readMarkerSet(*input.marker_set);
  }
  const std::string& name = settings.marker_set;
  // The name is a word, never a path.
  require(!name.empty() && name.find_first_of("/\\.") == std::string::npos,
          ErrorCode::kSettingsValue,
          "'" + name + "' is not the name of a marker set",
          {{}, 0, 0, "scale.marker_set"});
  try {
    return readMarkerSet(
        {name + ".json", readFile(models_folder + "/marker_sets/" + name + ".json")});
  } catch (const Error& error) {
    require(error.code() != ErrorCode::kFileNotFound,
            ErrorCode::kMarkerSetNotFound,
            "there is no marker set '" + name + "'",
            {{}, 0, 0, "scale.marker_set"});
    throw;
  }
}

void resolveMarkers(Job& job) {
  if (!job.settings.runs(Stage::kScale) && !job.settings.runs(Stage::kIk)) {
    return;
  }
  job.marker_names = mapMarkerNames(listMeasured(job), findOverrides(job));
  job.marker_set = openMarkerSet(*job.input, job.settings, job.models_folder);
}

}  // namespace gaitmill

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/intake/automatic_marker_set.h"
#include "core/intake/marker_geometry.h"
#include "core/intake/marker_proposals.h"
#include "core/intake/rigid_markers.h"
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

std::vector<const MarkerTrajectories*> listRecordings(const Job& job) {
  std::vector<const MarkerTrajectories*> recordings;
  for (const MarkerTrajectories& pose : job.static_poses) {
    recordings.push_back(&pose);
  }
  recordings.push_back(&job.markers);
  return recordings;
}

/// "; nobody knows M1 (perhaps RASI), M2, ...", the first few of them.
std::string describeUnmapped(const MarkerMapping& mapping) {
  constexpr std::size_t kMostNamed = 8;
  const std::vector<std::string> unmapped = mapping.listUnmapped();
  std::string text;
  for (std::size_t i = 0; i < unmapped.size() && i < kMostNamed; ++i) {
    const MarkerName& name = *mapping.find(unmapped[i]);
    text += (text.empty() ? "; without a landmark: " : ", ") + name.measured +
            (name.proposal.empty() ? "" : " (perhaps " + name.proposal + ")");
  }
  return text + (unmapped.size() > kMostNamed
                     ? " and " + std::to_string(unmapped.size() - kMostNamed) + " more"
                     : "");
}

void requireLandmarks(const MarkerMapping& mapping) {
  const std::vector<MissingLandmarks> missing = listMissingLandmarks(mapping);
  require(missing.empty(),
          ErrorCode::kMarkersMissing,
          "the markers do not say where these parts of the body are: " + describeMissing(missing) +
              describeUnmapped(mapping),
          {{}, 0, 0, "trial.marker_names"});
}

/// How the names were read, how sure that is on average, and what is left over.
Decision decideNames(const MarkerMapping& mapping) {
  Decision decision{"", "marker_names", "trial.marker_names", mapping.set, {}, 0, ""};
  decision.origin = Decision::Origin::kDetected;
  std::string others;
  int mapped = 0;
  for (const MarkerName& name : mapping.names) {
    decision.confidence += name.confidence;
    mapped += name.landmark.empty() ? 0 : 1;
    others +=
        name.landmark.empty() ? (others.empty() ? "; without one: " : ", ") + name.measured : "";
  }
  decision.confidence /= std::max<double>(1, mapped);
  decision.evidence = std::to_string(mapped) + " of " + std::to_string(mapping.names.size()) +
                      " markers are known landmarks, " + formatFixed(100 * mapping.set_share, 0) +
                      " % of the names are those of " +
                      (mapping.set.empty() ? "no set" : mapping.set) + others;
  return decision;
}

void addDecision(const char* topic, const std::string& evidence, Job& job) {
  Decision decision{"", topic, "scale.marker_set", kAutomaticMarkerSet, {}, 1, evidence};
  decision.origin = Decision::Origin::kDetected;
  job.decisions.push_back(decision);
}

/// The set that follows from the names, with markers nobody knows added to the segment they move
/// with.
MarkerSetSpec makeOwnMarkerSet(Job& job) {
  const std::vector<const MarkerTrajectories*> recordings = listRecordings(job);
  checkMarkerGeometry(recordings, job.marker_names);
  proposeLandmarks(recordings, job.marker_names);
  for (const std::string& warning : job.marker_names.warnings) {
    job.warn("markers: " + warning);
  }
  requireLandmarks(job.marker_names);
  job.decisions.push_back(decideNames(job.marker_names));
  AutomaticMarkerSet made = makeAutomaticMarkerSet(
      {job.marker_names, job.static_poses, job.markers, job.generic, job.input->height});
  for (const std::string& warning : made.warnings) {
    job.warn("markers: " + warning);
  }
  for (const std::string& note : made.notes) {
    addDecision("measurement", note, job);
  }
  // The static pose gives a marker its place; without one it stays out.
  if (!job.static_poses.empty()) {
    const std::vector<RigidMarker> rigid = findRigidMarkers(recordings, job.marker_names);
    for (const std::string& sentence :
         addRigidMarkers(rigid, job.generic, job.marker_names, made.set)) {
      addDecision("added_marker", sentence, job);
    }
  }
  return std::move(made.set);
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

bool isAutomatic(const TrialInput& input, const PipelineSettings& settings) {
  return !input.marker_set && settings.marker_set == kAutomaticMarkerSet;
}

void resolveMarkers(Job& job) {
  if (!job.settings.runs(Stage::kScale) && !job.settings.runs(Stage::kIk)) {
    return;
  }
  job.marker_names = mapMarkerNames(listMeasured(job), findOverrides(job));
  job.marker_set = isAutomatic(*job.input, job.settings)
                       ? makeOwnMarkerSet(job)
                       : openMarkerSet(*job.input, job.settings, job.models_folder);
}

}  // namespace gaitmill

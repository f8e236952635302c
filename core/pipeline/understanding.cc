#include "core/pipeline/understanding.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

#include "core/base/text.h"
#include "core/io/files.h"
#include "core/io/grf_reader.h"
#include "core/pipeline/gait_reading.h"
#include "core/pipeline/marker_set_json.h"

namespace gaitmill {

namespace {

MarkerMatch matchOne(const std::set<std::string>& measured, const MarkerSetSpec& set) {
  MarkerMatch match;
  match.marker_set = set.name;
  for (const MarkerWeight& weighted : set.ik.markers) {
    if (weighted.weight > 0) {
      (measured.count(weighted.marker) > 0 ? match.found : match.missing)
          .push_back(weighted.marker);
    }
  }
  return match;
}

double calcShare(const MarkerMatch& match) {
  const std::size_t asked = match.found.size() + match.missing.size();
  return asked == 0 ? 0.0 : static_cast<double>(match.found.size()) / static_cast<double>(asked);
}

void warnOfDisjointTimes(const std::vector<double>& forces,
                         const MarkerTrajectories& markers,
                         std::vector<std::string>& warnings) {
  const bool both = !forces.empty() && !markers.time.empty();
  if (both && (forces.back() < markers.time.front() || markers.time.back() < forces.front())) {
    warnings.push_back("the forces (" + formatFixed(forces.front(), 3) + " to " +
                       formatFixed(forces.back(), 3) +
                       " s) and the markers have no time in common");
  }
}

}  // namespace

std::vector<MarkerMatch> matchMarkers(const std::vector<std::string>& measured,
                                      const std::vector<MarkerSetSpec>& sets) {
  const std::set<std::string> names(measured.begin(), measured.end());
  std::vector<MarkerMatch> matches;
  for (const MarkerSetSpec& set : sets) {
    matches.push_back(matchOne(names, set));
  }
  std::stable_sort(matches.begin(), matches.end(), [](const MarkerMatch& a, const MarkerMatch& b) {
    return calcShare(a) != calcShare(b) ? calcShare(a) > calcShare(b)
                                        : a.found.size() > b.found.size();
  });
  return matches;
}

std::vector<MarkerSetSpec> readShippedMarkerSets(const std::string& models_folder) {
  std::vector<MarkerSetSpec> sets;
  for (const std::string& path : listFiles(models_folder + "/marker_sets", ".json")) {
    sets.push_back(readMarkerSet({path, readFile(path)}));
  }
  return sets;
}

Gait understandForces(ForceReading forces,
                      const MarkerTrajectories& markers,
                      std::vector<std::string>& warnings) {
  GrfOptions options;
  options.unnamed = UnnamedPlates::kKeep;
  const GroundReaction plates = selectForces(std::move(forces.plates),
                                             forces.feet,
                                             options,
                                             forces.table ? &*forces.table : nullptr,
                                             &warnings);
  warnOfDisjointTimes(plates.time, markers, warnings);
  return describeGait(plates, forces.feet, markers, findGaitMarkersByLandmark(markers.names));
}

Gait understandMovement(const MarkerTrajectories& markers) {
  return describeGait({}, {}, markers, findGaitMarkersByLandmark(markers.names));
}

EmgUnderstanding understandEmg(const TimeSeries& recording) {
  EmgChannels mapped = mapEmgChannels(recording.labels, {}, {});
  return {findEmgSource(recording), std::move(mapped.channels), std::move(mapped.warnings)};
}

}  // namespace gaitmill

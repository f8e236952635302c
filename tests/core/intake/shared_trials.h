#pragma once

#include <array>
#include <cctype>
#include <string>
#include <vector>

#include "core/data/ground_reaction.h"
#include "core/data/marker_trajectories.h"
#include "core/intake/laboratory.h"
#include "core/io/files.h"
#include "core/io/grf_reader.h"
#include "core/io/table_reader.h"
#include "core/io/trc_reader.h"
#include "tests/support/shared_data.h"

namespace gaitmill {

/// A recorded movement of ../shared; paths below its data folder.
struct SharedTrial {
  const char* markers;
  const char* forces;
};

inline const std::vector<SharedTrial>& sharedTrials() {
  static const std::vector<SharedTrial> trials = {
      {"walk/motion_capture_walk.trc", "walk/grf_walk.mot"},
      {"run/paper_subject01/motion_capture_run.trc", "run/paper_subject01/grf_run.mot"},
      {"run/hamner2010/subject02_running.trc", "run/hamner2010/subject02_running_grf.mot"},
      {"run/hamner2013_subject04/run400/markers.trc", "run/hamner2013_subject04/run400/grf.mot"}};
  return trials;
}

inline MarkerTrajectories readSharedMarkers(const SharedTrial& trial) {
  const std::string path = findSharedFolder() + "/data/" + trial.markers;
  return readTrc(readFile(path), path).markers;
}

inline GroundReaction readSharedForces(const SharedTrial& trial) {
  const std::string path = findSharedFolder() + "/data/" + trial.forces;
  return readGroundReaction(readTable(readFile(path), path));
}

inline BodyMarkers findBodyMarkers(const MarkerTrajectories& markers) {
  constexpr std::array<const char*, 7> kParts = {
      "HEEL", "CAL", "TOE", "MT", "ANK", "MAL", "MIDFOOT"};
  BodyMarkers body;
  for (int i = 0; i < markers.markerCount(); ++i) {
    std::string letters;
    for (const char c : markers.names[static_cast<std::size_t>(i)]) {
      letters += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
    bool is_foot = false;
    for (const char* part : kParts) {
      is_foot = is_foot || letters.find(part) != std::string::npos;
    }
    (!is_foot ? body.others : letters[0] == 'R' ? body.right_foot : body.left_foot).push_back(i);
  }
  return body;
}

}  // namespace gaitmill

#include "core/intake/rigid_markers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "core/base/text.h"
#include "core/intake/landmarks.h"

namespace gaitmill {

namespace {

constexpr int kFewestFrames = 20;
constexpr int kFrames = 200;            // of each recording that are looked at
constexpr double kClearlyBetter = 1.5;  // times the next segment's deviation
constexpr double kSayInKinematics = 0.1;

/// Landmarks by the segment they move with; those of the ankle bone have none of their own.
std::map<std::string, std::vector<std::string>> groupByBody(const MarkerMapping& mapping) {
  std::map<std::string, std::vector<std::string>> groups;
  for (const MarkerName& name : mapping.names) {
    const Landmark* landmark = findLandmark(name.landmark);
    if (landmark != nullptr && landmark->kind != LandmarkKind::kDerived) {
      groups[landmark->body].push_back(name.measured);
    }
  }
  return groups;
}

/// Standard deviation over all recordings of the distance of two markers; nullopt below
/// kFewestFrames [m].
std::optional<double> calcDeviation(const std::vector<const MarkerTrajectories*>& recordings,
                                    const std::string& first,
                                    const std::string& second) {
  double sum = 0;
  double squares = 0;
  int count = 0;
  for (const MarkerTrajectories* recording : recordings) {
    const std::optional<int> a = recording->findMarker(first);
    const std::optional<int> b = recording->findMarker(second);
    const int step = std::max(1, recording->frameCount() / kFrames);
    for (int frame = 0; a && b && frame < recording->frameCount(); frame += step) {
      if (!recording->isMissing(frame, *a) && !recording->isMissing(frame, *b)) {
        const double distance =
            (recording->position(frame, *a) - recording->position(frame, *b)).norm();
        sum += distance;
        squares += distance * distance;
        ++count;
      }
    }
  }
  if (count < kFewestFrames) {
    return std::nullopt;
  }
  const double mean = sum / count;
  return std::sqrt(std::max(0.0, squares / count - mean * mean));
}

/// The worst of a marker's distances to the markers of a segment; infinite below two of them.
double calcWorst(const std::vector<const MarkerTrajectories*>& recordings,
                 const std::string& measured,
                 const std::vector<std::string>& segment) {
  double worst = 0;
  int known = 0;
  for (const std::string& other : segment) {
    if (const std::optional<double> deviation = calcDeviation(recordings, measured, other)) {
      worst = std::max(worst, *deviation);
      ++known;
    }
  }
  return known < 2 ? std::numeric_limits<double>::infinity() : worst;
}

bool isCandidate(const MarkerName& name) {
  return name.landmark.empty() && !name.measured.empty() && name.measured[0] != '*' &&
         name.reason.rfind("to be ignored", 0) != 0 && name.reason.rfind("a result", 0) != 0;
}

/// Where the markers of a body are on average, as a place to start from.
Eigen::Vector3d calcCenter(const std::string& body, const MarkerMapping& mapping) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0;
  for (const MarkerName& name : mapping.names) {
    const Landmark* landmark = findLandmark(name.landmark);
    if (landmark != nullptr && landmark->body == body) {
      sum += landmark->location;
      count += 1;
    }
  }
  return count > 0 ? Eigen::Vector3d(sum / count) : sum;
}

double calcMeanWeight(const FitTasks& tasks) {
  double sum = 0;
  double count = 0;
  for (const MarkerWeight& marker : tasks.markers) {
    sum += marker.weight;
    count += marker.weight > 0 ? 1 : 0;
  }
  return count > 0 ? sum / count : 1.0;
}

}  // namespace

std::vector<RigidMarker> findRigidMarkers(const std::vector<const MarkerTrajectories*>& recordings,
                                          const MarkerMapping& mapping) {
  const std::map<std::string, std::vector<std::string>> groups = groupByBody(mapping);
  std::vector<RigidMarker> found;
  for (const MarkerName& name : mapping.names) {
    if (!isCandidate(name)) {
      continue;
    }
    RigidMarker best{name.measured, "", std::numeric_limits<double>::infinity()};
    double next = best.deviation;
    for (const auto& [body, segment] : groups) {
      const double deviation = calcWorst(recordings, name.measured, segment);
      next = std::min(next, std::max(deviation, best.deviation));
      if (deviation < best.deviation) {
        best.body = body;
        best.deviation = deviation;
      }
    }
    if (best.deviation < kRigidDeviation && next > kClearlyBetter * best.deviation) {
      found.push_back(best);
    }
  }
  return found;
}

std::vector<std::string> addRigidMarkers(const std::vector<RigidMarker>& markers,
                                         const ModelSpec& model,
                                         const MarkerMapping& mapping,
                                         MarkerSetSpec& set) {
  std::vector<std::string> sentences;
  const double weight = kSayInKinematics * calcMeanWeight(set.ik);
  for (const RigidMarker& marker : markers) {
    const std::optional<std::string> body = findModelBody(marker.body, model);
    if (!body) {
      continue;
    }
    set.markers.push_back({marker.measured, *body, calcCenter(marker.body, mapping), false});
    set.ik.markers.push_back({marker.measured, weight});
    sentences.push_back("'" + marker.measured + "' is no known landmark; it moves with " + *body +
                        " (distances constant to " + formatFixed(1000 * marker.deviation, 1) +
                        " mm) and is added to it where the static pose has it");
  }
  return sentences;
}

}  // namespace gaitmill

#include "core/intake/marker_geometry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <Eigen/Dense>

#include "core/base/text.h"
#include "core/intake/landmarks.h"

namespace gaitmill {

namespace {

using Eigen::Vector3d;

constexpr int kFrames = 40;         // of each recording that are looked at
constexpr double kCrossing = 0.05;  // [m] that a pair may lie on the wrong side
// [m] the same of shanks and feet, which cross the middle in running: the heads of the first
// metatarsals by 9 cm on average over a published trial.
constexpr double kShankCrossing = 0.10;
constexpr double kFootCrossing = 0.15;
constexpr double kHeightOrder = 0.20;   // [m] between heights of a standing person that count
constexpr double kHeightMargin = 0.05;  // [m] by which an order must be wrong
constexpr double kContradicted = 0.3;   // times the confidence
constexpr double kLeastSides = 0.05;    // [m] that sides must differ for their sense to count

/// A frame's position of a landmark that was measured, or NaN.
class Positions {
 public:
  Positions(const std::vector<const MarkerTrajectories*>& recordings,
            const MarkerMapping& mapping) {
    for (const MarkerTrajectories* recording : recordings) {
      const int step = std::max(1, recording->frameCount() / kFrames);
      for (int frame = 0; frame < recording->frameCount(); frame += step) {
        frames_.emplace_back();
        for (int marker = 0; marker < recording->markerCount(); ++marker) {
          const MarkerName* name = mapping.find(recording->names[static_cast<std::size_t>(marker)]);
          if (name != nullptr && !name->landmark.empty() && !recording->isMissing(frame, marker)) {
            frames_.back()[name->landmark] = recording->position(frame, marker);
          }
        }
      }
    }
  }

  const std::vector<std::map<std::string, Vector3d>>& frames() const { return frames_; }

 private:
  std::vector<std::map<std::string, Vector3d>> frames_;
};

using Frame = std::map<std::string, Vector3d>;

std::optional<Vector3d> findPosition(const Frame& frame, const std::string& landmark) {
  const auto found = frame.find(landmark);
  return found == frame.end() ? std::nullopt : std::optional<Vector3d>(found->second);
}

/// Mean over frames of one number that some frames have.
struct Mean {
  double sum = 0;
  int count = 0;
  void add(double value) {
    sum += value;
    ++count;
  }
  double value() const { return count == 0 ? 0 : sum / count; }
};

/// Two landmarks of which the first lies in front of the second.
struct FrontBack {
  const char* front;
  const char* back;
};

const std::vector<FrontBack>& frontsAndBacks() {
  static const std::vector<FrontBack> all = {{"@ASI", "@PSI"},
                                             {"@ASI", "SACR"},
                                             {"@ASI", "S2"},
                                             {"CLAV", "C7"},
                                             {"STRN", "T10"},
                                             {"XIPH", "T10"},
                                             {"STRN", "C7"},
                                             {"@TOE", "@CAL"},
                                             {"@MT1", "@CAL"},
                                             {"@MT2", "@CAL"},
                                             {"@MT5", "@CAL"},
                                             {"@TIP", "@CAL"},
                                             {"@HLX", "@CAL"},
                                             {"@FHD", "@BHD"},
                                             {"FHDmid", "BHDmid"}};
  return all;
}

std::string putSide(std::string text, char side) {
  std::replace(text.begin(), text.end(), '@', side);
  return text;
}

/// Landmarks of the trunk and pelvis whose line from left to right is the body's own.
bool isAcross(const Landmark& landmark) {
  return landmark.side == Side::kRight && std::abs(landmark.location.z()) > 0.02 &&
         (landmark.body == "pelvis" || landmark.body == "torso" || landmark.name == "RHJC" ||
          landmark.name == "RSJC");
}

/// The horizontal direction to the right by the majority of the pairs; nullopt without any.
std::optional<Vector3d> findRight(const Frame& frame) {
  std::vector<Vector3d> pairs;
  for (const auto& [name, position] : frame) {
    const Landmark* landmark = findLandmark(name);
    const std::optional<Vector3d> other = findPosition(frame, findOpposite(name)->name);
    if (isAcross(*landmark) && other) {
      Vector3d across = position - *other;
      across.y() = 0;
      pairs.push_back(across);
    }
  }
  if (pairs.empty()) {
    return std::nullopt;
  }
  // The widest pair gives the line, all of them its sense.
  const auto widest =
      std::max_element(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) {
        return a.squaredNorm() < b.squaredNorm();
      });
  if (widest->norm() < kLeastSides) {
    return std::nullopt;
  }
  const Vector3d line = widest->normalized();
  Vector3d sum = Vector3d::Zero();
  double votes = 0;
  for (const Vector3d& pair : pairs) {
    const double along = pair.dot(line);
    votes += along > 0 ? 1 : -1;
    sum += along > 0 ? pair : Vector3d(-pair);
  }
  const Vector3d right = sum.normalized();
  return votes < 0 ? Vector3d(-right) : right;
}

/// What of the frames speaks for and against the names.
struct Evidence {
  std::map<std::string, Mean> sides;  // by the right one of a pair: how far right of the left one
  std::map<std::pair<std::string, std::string>, Mean> fronts;  // how far the first lies in front
  Mean forward;                                                // all of these
};

void addFronts(const Frame& frame, const Vector3d& forward, Evidence& evidence) {
  for (const FrontBack& pair : frontsAndBacks()) {
    for (const char side : {'R', 'L'}) {
      const std::string front = putSide(pair.front, side);
      const std::string back = putSide(pair.back, side);
      const std::optional<Vector3d> p = findPosition(frame, front);
      const std::optional<Vector3d> q = findPosition(frame, back);
      if (p && q && (side == 'R' || front != pair.front)) {
        const double ahead = (*p - *q).dot(forward);
        evidence.fronts[{front, back}].add(ahead);
        evidence.forward.add(ahead);
      }
    }
  }
}

Evidence collect(const Positions& positions) {
  Evidence evidence;
  for (const Frame& frame : positions.frames()) {
    const std::optional<Vector3d> right = findRight(frame);
    if (!right) {
      continue;
    }
    for (const auto& [name, position] : frame) {
      const std::optional<Vector3d> other = findPosition(frame, findOpposite(name)->name);
      if (findLandmark(name)->side == Side::kRight && other) {
        evidence.sides[name].add((position - *other).dot(*right));
      }
    }
    addFronts(frame, Vector3d::UnitY().cross(*right), evidence);
  }
  return evidence;
}

std::string inCentimetres(double metres) {
  return formatFixed(100 * metres, 1) + " cm";
}

MarkerName* findName(MarkerMapping& mapping, const std::string& landmark) {
  for (MarkerName& name : mapping.names) {
    if (name.landmark == landmark) {
      return &name;
    }
  }
  return nullptr;
}

/// Takes a marker out of use unless somebody stated what it is.
void contradict(MarkerName& name, const std::string& why, const std::string& instead) {
  if (name.confidence >= 1) {
    return;
  }
  name.proposal = instead.empty() ? name.landmark : instead;
  name.proposal_confidence = kContradicted * name.confidence;
  name.landmark.clear();
  name.confidence = 0;
  name.reason = why;
}

/// @returns whether all sides are exchanged
bool checkAllSides(const Evidence& evidence, MarkerMapping& mapping) {
  if (evidence.forward.count == 0 || evidence.forward.value() > -0.02) {
    return false;
  }
  mapping.warnings.push_back(
      "left and right are exchanged in all marker names, or the axes of the file are mirrored: "
      "with "
      "these names toes and fronts lie " +
      inCentimetres(-evidence.forward.value()) + " behind heels and backs on average");
  for (MarkerName& name : mapping.names) {
    const Landmark* landmark = findLandmark(name.landmark);
    if (landmark != nullptr && landmark->side != Side::kMiddle) {
      contradict(name, "its side contradicts the positions", findOpposite(name.landmark)->name);
    }
  }
  return true;
}

/// How far the markers of a pair may lie on each other's side [m].
double findCrossing(const std::string& landmark) {
  const std::string& body = findLandmark(landmark)->body;
  if (body.rfind("calcn", 0) == 0 || body.rfind("toes", 0) == 0) {
    return kFootCrossing;
  }
  return body.rfind("tibia", 0) == 0 ? kShankCrossing : kCrossing;
}

void checkPairs(const Evidence& evidence, MarkerMapping& mapping) {
  for (const auto& [name, distance] : evidence.sides) {
    MarkerName* right = findName(mapping, name);
    MarkerName* left = findName(mapping, findOpposite(name)->name);
    if (distance.value() > -findCrossing(name) || right == nullptr || left == nullptr) {
      continue;
    }
    const std::string why = "'" + right->measured + "' lies " + inCentimetres(-distance.value()) +
                            " to the left of '" + left->measured + "'";
    mapping.warnings.push_back(why + ": their names look exchanged");
    const std::string right_landmark = right->landmark;
    contradict(*right, why, left->landmark);
    contradict(*left, why, right_landmark);
  }
}

void checkFronts(const Evidence& evidence, MarkerMapping& mapping) {
  std::map<std::string, int> wrong;
  std::map<std::string, int> seen;
  for (const auto& [pair, distance] : evidence.fronts) {
    for (const std::string& name : {pair.first, pair.second}) {
      seen[name] += 1;
      wrong[name] += distance.value() < -kCrossing ? 1 : 0;
    }
  }
  // Names are contradicted after all pairs were looked at: one that has lost its landmark would not
  // be found for its next pair.
  std::vector<std::pair<MarkerName*, std::string>> contradicted;
  for (const auto& [pair, distance] : evidence.fronts) {
    MarkerName* front = findName(mapping, pair.first);
    MarkerName* back = findName(mapping, pair.second);
    if (distance.value() > -kCrossing || front == nullptr || back == nullptr) {
      continue;
    }
    const std::string why = "'" + front->measured + "' lies " + inCentimetres(-distance.value()) +
                            " behind '" + back->measured + "'";
    mapping.warnings.push_back(why + ": their names contradict that");
    // A marker that is right with others is not the wrong one of the two.
    const bool only_front = 2 * wrong[pair.second] < seen[pair.second];
    const bool only_back = 2 * wrong[pair.first] < seen[pair.first];
    if (!only_back) {
      contradicted.emplace_back(front, why);
    }
    if (!only_front) {
      contradicted.emplace_back(back, why);
    }
  }
  for (const auto& [name, why] : contradicted) {
    if (!name->landmark.empty()) {
      contradict(*name, why, "");
    }
  }
}

/// Heights of a landmark whose height says something in every pose of gait.
struct Height {
  std::string landmark;
  double standing;  // [m]
};

bool isOfArm(const std::string& body) {
  return body.rfind("humerus", 0) == 0 || body.rfind("ulna", 0) == 0 ||
         body.rfind("radius", 0) == 0 || body.rfind("hand", 0) == 0;
}

std::vector<Height> listHeights(const MarkerMapping& mapping) {
  std::vector<Height> heights;
  for (const MarkerName& name : mapping.names) {
    const Landmark* landmark = findLandmark(name.landmark);
    if (landmark != nullptr && !isOfArm(landmark->body)) {
      heights.push_back({name.landmark, calcStandingPosition(*landmark).y()});
    }
  }
  return heights;
}

/// Pairs whose heights are the wrong way round: how far on average [m].
struct Inversion {
  std::string high;
  std::string low;
  double by;
};

std::vector<Inversion> findInversions(const Positions& positions, const MarkerMapping& mapping) {
  std::vector<Inversion> inversions;
  const std::vector<Height> heights = listHeights(mapping);
  for (const Height& high : heights) {
    for (const Height& low : heights) {
      if (high.standing - low.standing < kHeightOrder) {
        continue;
      }
      Mean difference;
      for (const Frame& frame : positions.frames()) {
        const auto a = frame.find(high.landmark);
        const auto b = frame.find(low.landmark);
        if (a != frame.end() && b != frame.end()) {
          difference.add(a->second.y() - b->second.y());
        }
      }
      if (difference.value() < -kHeightMargin) {
        inversions.push_back({high.landmark, low.landmark, -difference.value()});
      }
    }
  }
  return inversions;
}

using Counts = std::map<std::string, int>;

Counts countInversions(const std::vector<Inversion>& inversions) {
  Counts counts;
  for (const Inversion& inversion : inversions) {
    ++counts[inversion.high];
    ++counts[inversion.low];
  }
  return counts;
}

/// "'RCAL' lies 42.0 cm above 'RLFC'"
std::string describe(const Inversion& inversion, const MarkerMapping& mapping) {
  return "'" + *mapping.findMeasured(inversion.low) + "' lies " + inCentimetres(inversion.by) +
         " above '" + *mapping.findMeasured(inversion.high) + "'";
}

/// The inversion whose markers have most others against them; both, where neither has more.
std::vector<std::string> findCulprits(const Inversion& inversion, const Counts& counts) {
  const int high = counts.at(inversion.high);
  const int low = counts.at(inversion.low);
  if (high == low) {
    return {inversion.high, inversion.low};
  }
  return {high > low ? inversion.high : inversion.low};
}

/// Takes out the markers with most contradictions until there are none.
void checkHeights(const Positions& positions, MarkerMapping& mapping) {
  std::vector<Inversion> inversions = findInversions(positions, mapping);
  while (!inversions.empty()) {
    const Counts counts = countInversions(inversions);
    const auto most = [&counts](const Inversion& inversion) {
      return std::max(counts.at(inversion.high), counts.at(inversion.low));
    };
    const Inversion worst =
        *std::max_element(inversions.begin(), inversions.end(), [&](const auto& a, const auto& b) {
          return most(a) < most(b);
        });
    const std::string why = describe(worst, mapping);
    mapping.warnings.push_back(why + ": their heights contradict their names");
    const std::vector<std::string> culprits = findCulprits(worst, counts);
    for (const std::string& landmark : culprits) {
      contradict(*findName(mapping, landmark), why, "");
    }
    const auto is_settled = [&](const Inversion& inversion) {
      return std::count(culprits.begin(), culprits.end(), inversion.high) +
                 std::count(culprits.begin(), culprits.end(), inversion.low) >
             0;
    };
    inversions.erase(std::remove_if(inversions.begin(), inversions.end(), is_settled),
                     inversions.end());
  }
}

}  // namespace

void checkMarkerGeometry(const std::vector<const MarkerTrajectories*>& recordings,
                         MarkerMapping& mapping) {
  const Positions positions(recordings, mapping);
  const Evidence evidence = collect(positions);
  if (checkAllSides(evidence, mapping)) {
    return;
  }
  checkPairs(evidence, mapping);
  checkFronts(evidence, mapping);
  checkHeights(positions, mapping);
}

}  // namespace gaitmill

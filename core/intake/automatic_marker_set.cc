#include "core/intake/automatic_marker_set.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/intake/landmarks.h"
#include "core/intake/measurement_table.h"
#include "core/intake/still_range.h"

namespace gaitmill {

namespace {

/// Band of a factor (spec/scale.md 7), wider for subjects that are small or tall as a whole.
constexpr double kMinFactor = 0.7;
constexpr double kMaxFactor = 1.4;
/// A pair counts if it is seen in so many frames; as ScaleOptions has it.
constexpr double kMinVisible = 0.8;
/// A marker pulls in the static fit if it is seen in half of the frames: the subject stands still.
constexpr double kMinVisiblePlacement = 0.5;
/// Deviation of a bony landmark [m], which then weighs 1.
constexpr double kBonyDeviation = 0.012;
/// Markers that a body needs to show all its rotations.
constexpr int kMarkersOfABody = 3;
/// Without so many others the markers on the shoulders are needed to see the trunk turn.
constexpr int kMarkersOfATrunk = 2;
/// Pull of a coordinate that few markers show: at a lever of 6 cm and weight 1 it costs 3 % of the
/// movement, at 25 cm 0.2 % [m^2/rad^2].
constexpr double kHoldingWeight = 1e-4;
/// Cosine of 60 deg from hanging down: from there on the shoulder blade turns along.
constexpr double kRaisedArm = 0.5;
/// Markers on the shoulder blade: sided places of the torso above this and further out [m].
constexpr double kShoulderHeight = 0.36;
constexpr double kShoulderWidth = 0.08;
/// Above this a place of the torso is on the head, which turns by itself [m].
constexpr double kHeadHeight = 0.47;

/// How far the skin moves over the bone in walking and running [m], with kind and body of a marker
/// (Leardini et al. 2005, Gait Posture 21:212: up to 1 cm at the shank and pelvis, up to 3 cm at
/// the thigh; feet are stiffest).
struct SkinRow {
  const char* body;  ///< without side
  double bony;
  double technical;
};
constexpr SkinRow kSkin[] = {
    {"pelvis", 0.008, 0.012},
    {"torso", 0.010, 0.015},
    {"femur", 0.015, 0.018},
    {"tibia", 0.010, 0.012},
    {"calcn", 0.008, 0.010},
    {"toes", 0.012, 0.015},
};
constexpr double kOtherSkin = 0.015;

std::string findStem(const std::string& body) {
  const bool sided = body.size() > 2 && body[body.size() - 2] == '_';
  return sided ? body.substr(0, body.size() - 2) : body;
}

bool isOnHead(const Landmark& mark) {
  return mark.body == "torso" && mark.location.y() > kHeadHeight;
}

bool isOnShoulder(const Landmark& mark) {
  return mark.body == "torso" && !isOnHead(mark) && mark.location.y() > kShoulderHeight &&
         std::abs(mark.location.z()) > kShoulderWidth;
}

double calcIkWeight(const Landmark& mark) {
  double deviation = kOtherSkin;
  for (const SkinRow& row : kSkin) {
    if (findStem(mark.body) == row.body) {
      deviation = mark.kind == LandmarkKind::kTechnical ? row.technical : row.bony;
    }
  }
  return 1e-4 / (deviation * deviation);
}

double calcStaticWeight(const Landmark& mark) {
  const double ratio = kBonyDeviation / mark.placement_deviation;
  return ratio * ratio;
}

/// "LFC" and the right side give "RLFC", "C7" gives itself, "<ASI" is the left one.
std::string makeSidedName(const std::string& name, Side side) {
  if (name[0] == '<' || name[0] == '>') {
    return (name[0] == '<' ? "L" : "R") + name.substr(1);
  }
  return (side == Side::kLeft ? "L" : "R") + name;
}

/// A landmark that was measured, on the model.
struct Placed {
  const Landmark* mark;
  std::string marker;  ///< measured name
  std::string body;    ///< the model's name
};

class Builder {
 public:
  explicit Builder(const AutomaticSetInput& input) : input_(input) {}

  AutomaticMarkerSet make() {
    const double ratio = input_.height > 0 ? input_.height / input_.model_height : 1.0;
    result_.set.name = "auto";
    result_.set.description = "Made from the markers of the trial.";
    result_.set.size_ratio = ratio;
    findStill();
    findLandmarks();
    findRaisedArms();
    addMarkers();
    addMeasurements();
    addPlacements();
    addIk();
    return std::move(result_);
  }

 private:
  void findStill();
  void findLandmarks();
  void findRaisedArms();
  void addMarkers();
  void addMeasurements();
  void addGroup(const std::vector<const MeasurementLine*>& lines);
  std::optional<MeasurementSpec> makeMeasurement(const MeasurementLine& line,
                                                 const std::vector<Side>& sides);
  void addPlacements();
  void addIk();
  FitTasks makeTasks(const MarkerTrajectories& trial, bool is_static);
  void holdUnseenCoordinates(const std::map<std::string, int>& seen, FitTasks& tasks);

  const Placed* findPlaced(const std::string& landmark) const;
  bool isMeasured(const std::string& landmark) const;
  bool isOnRaisedShoulder(const Placed& placed) const;
  int countOnTrunk() const;
  std::optional<std::string> findPoint(const std::string& name, Side side);
  std::string makeMean(const std::vector<std::string>& marks);
  std::vector<std::string> findBodies(const MeasurementLine& line,
                                      const std::vector<Side>& sides) const;

  const AutomaticSetInput& input_;
  AutomaticMarkerSet result_;
  std::vector<StillRange> still_;  ///< one per static pose
  std::vector<Placed> placed_;     ///< of any trial
  std::set<std::string> virtual_names_;
  std::set<Side> raised_arms_;  ///< in the first static trial
};

void Builder::findStill() {
  for (std::size_t i = 0; i < input_.static_poses.size(); ++i) {
    still_.push_back(findStillRange(input_.static_poses[i]));
    for (const std::string& warning : still_.back().warnings) {
      result_.warnings.push_back(input_.static_poses.size() == 1
                                     ? warning
                                     : "static trial " + std::to_string(i + 1) + ": " + warning);
    }
  }
  if (!still_.empty()) {
    result_.set.measurement_range = still_.front().range;
  }
}

void Builder::findLandmarks() {
  for (const MarkerName& name : input_.mapping.names) {
    const Landmark* mark = name.landmark.empty() ? nullptr : findLandmark(name.landmark);
    if (mark == nullptr) {
      continue;
    }
    const std::optional<std::string> body = findModelBody(mark->body, input_.model);
    if (body) {
      placed_.push_back({mark, name.measured, *body});
    }
  }
  require(!placed_.empty(),
          ErrorCode::kInputMarkers,
          "none of the markers is a known landmark of a body that the model has");
}

bool Builder::isOnRaisedShoulder(const Placed& placed) const {
  return raised_arms_.count(placed.mark->side) > 0 && isOnShoulder(*placed.mark);
}

Eigen::Vector3d calcMean(const MarkerTrajectories& trial, int marker, const TimeRange& range) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int seen = 0;
  for (int frame = 0; frame < trial.frameCount(); ++frame) {
    const double time = trial.time[static_cast<std::size_t>(frame)];
    if (time >= range.start && time <= range.end && !trial.isMissing(frame, marker)) {
      sum += trial.position(frame, marker);
      ++seen;
    }
  }
  return sum / seen;
}

/// Markers of the trunk that are neither on the head nor on the shoulders.
int Builder::countOnTrunk() const {
  int count = 0;
  for (const Placed& placed : placed_) {
    const Landmark& mark = *placed.mark;
    const bool counts = mark.body == "torso" && !isOnHead(mark) && !isOnShoulder(mark) &&
                        mark.kind != LandmarkKind::kDerived;
    count += counts ? 1 : 0;
  }
  return count;
}

// The shoulder blade turns with a raised arm and takes its markers along, which the model's torso
// does not: they stay where the catalogue has them.
void Builder::findRaisedArms() {
  for (const Side side : {Side::kRight, Side::kLeft}) {
    const std::string acromion = makeSidedName("ACR", side);
    const std::string elbow = makeSidedName("LEL", side);
    if (!isMeasured(acromion) || !isMeasured(elbow)) {
      continue;
    }
    const MarkerTrajectories& trial = input_.static_poses.front();
    const TimeRange& range = still_.front().range;
    const Eigen::Vector3d arm =
        calcMean(trial, *trial.findMarker(findPlaced(elbow)->marker), range) -
        calcMean(trial, *trial.findMarker(findPlaced(acromion)->marker), range);
    if (arm.y() > -kRaisedArm * arm.norm()) {
      raised_arms_.insert(side);
    }
  }
  // Without other markers on the trunk its pose is theirs to tell.
  if (countOnTrunk() < kMarkersOfATrunk) {
    raised_arms_.clear();
  }
  if (!raised_arms_.empty()) {
    result_.notes.emplace_back(
        "arms are raised in the static trial: the markers on the shoulders rise with them and stay "
        "where the generic model has them");
  }
}

void Builder::addMarkers() {
  for (const Placed& placed : placed_) {
    // A joint centre is where the model has it; everything else is where it was measured.
    const bool fixed =
        placed.mark->kind == LandmarkKind::kJointCenter || isOnRaisedShoulder(placed);
    result_.set.markers.push_back({placed.marker, placed.body, placed.mark->location, fixed});
    result_.set.place_deviations[placed.marker] = placed.mark->placement_deviation;
  }
}

const Placed* Builder::findPlaced(const std::string& landmark) const {
  const auto found = std::find_if(placed_.begin(), placed_.end(), [&](const Placed& placed) {
    return placed.mark->name == landmark;
  });
  return found == placed_.end() ? nullptr : &*found;
}

/// Whether a landmark can be measured in the first static trial.
bool Builder::isMeasured(const std::string& landmark) const {
  const Placed* placed = findPlaced(landmark);
  if (placed == nullptr || input_.static_poses.empty()) {
    return false;
  }
  const MarkerTrajectories& trial = input_.static_poses.front();
  const std::optional<int> column = trial.findMarker(placed->marker);
  if (!column) {
    return false;
  }
  int seen = 0, frames = 0;
  for (int frame = 0; frame < trial.frameCount(); ++frame) {
    const double time = trial.time[static_cast<std::size_t>(frame)];
    if (time >= still_.front().range.start && time <= still_.front().range.end) {
      seen += trial.isMissing(frame, *column) ? 0 : 1;
      ++frames;
    }
  }
  return seen > 0 && seen >= kMinVisible * frames;
}

/// The marker of a landmark or point; a mean of several becomes a virtual one.
std::optional<std::string> Builder::findPoint(const std::string& name, Side side) {
  for (const SkeletonPoint& point : skeletonPoints()) {
    if (point.name != name) {
      continue;
    }
    for (const std::vector<std::string>& way : point.ways) {
      std::vector<std::string> marks;
      for (const std::string& mark : way) {
        marks.push_back(point.sided ? makeSidedName(mark, side) : mark);
      }
      if (std::all_of(marks.begin(), marks.end(), [&](const std::string& mark) {
            return isMeasured(mark);
          })) {
        return makeMean(marks);
      }
    }
    return std::nullopt;
  }
  const std::string sided = makeSidedName(name, side);
  const std::string mark = findLandmark(sided) != nullptr ? sided : name;
  return isMeasured(mark) ? std::optional(findPlaced(mark)->marker) : std::nullopt;
}

std::string Builder::makeMean(const std::vector<std::string>& marks) {
  if (marks.size() == 1) {
    return findPlaced(marks.front())->marker;
  }
  VirtualMarkerSpec point{"mid", VirtualMarkerSpec::Rule::kMean, {}};
  Eigen::Vector3d location = Eigen::Vector3d::Zero();
  for (const std::string& mark : marks) {
    const Placed& placed = *findPlaced(mark);
    point.name += "_" + placed.marker;
    point.sources.push_back(placed.marker);
    location += placed.mark->location / static_cast<double>(marks.size());
  }
  if (virtual_names_.insert(point.name).second) {
    result_.set.markers.push_back({point.name, findPlaced(marks.front())->body, location, true});
    result_.set.virtual_markers.push_back(point);
  }
  return point.name;
}

std::vector<std::string> Builder::findBodies(const MeasurementLine& line,
                                             const std::vector<Side>& sides) const {
  std::vector<std::string> bodies;
  for (const std::string& stem : line.bodies) {
    const bool single = stem == "pelvis" || stem == "torso";
    for (const Side side : sides) {
      const std::string body = single ? stem : stem + (side == Side::kLeft ? "_l" : "_r");
      const std::optional<std::string> found = findModelBody(body, input_.model);
      if (found && std::find(bodies.begin(), bodies.end(), *found) == bodies.end()) {
        bodies.push_back(*found);
      }
    }
  }
  return bodies;
}

/// The line with the pairs of these sides that can be measured; nothing if there is none.
std::optional<MeasurementSpec> Builder::makeMeasurement(const MeasurementLine& line,
                                                        const std::vector<Side>& sides) {
  MeasurementSpec measurement;
  std::set<std::pair<std::string, std::string>> known;
  for (const auto& [first, second] : line.pairs) {
    for (const Side side : sides) {
      const std::optional<std::string> a = findPoint(first, side);
      const std::optional<std::string> b = findPoint(second, side);
      if (a && b && known.insert({*a, *b}).second) {
        measurement.pairs.push_back({*a, *b});
      }
    }
  }
  if (measurement.pairs.empty()) {
    return std::nullopt;
  }
  measurement.axes = line.axes;
  measurement.required = false;
  measurement.in_fitted_pose = line.in_fitted_pose;
  measurement.min_factor = kMinFactor * std::min(1.0, result_.set.size_ratio);
  measurement.max_factor = kMaxFactor * std::max(1.0, result_.set.size_ratio);
  return measurement;
}

void Builder::addMeasurements() {
  std::vector<std::vector<const MeasurementLine*>> groups;
  for (const MeasurementLine& line : measurementLines()) {
    if (groups.empty() || groups.back().front()->group != line.group) {
      groups.emplace_back();
    }
    groups.back().push_back(&line);
  }
  for (const auto& lines : groups) {
    addGroup(lines);
  }
}

/// One group for both sides, or one for each, which may borrow from the other side.
void Builder::addGroup(const std::vector<const MeasurementLine*>& lines) {
  const std::string& group = lines.front()->group;
  const bool single =
      lines.front()->bodies.front() == "pelvis" || lines.front()->bodies.front() == "torso";
  struct Part {
    std::string suffix;
    std::vector<Side> own;
    std::vector<std::vector<Side>> measured;  ///< sides to look at, one after the other
  };
  const std::vector<Side> both = {Side::kRight, Side::kLeft};
  std::vector<Part> parts = {{"", both, {both}}};
  if (!input_.symmetric && !single) {
    parts = {{" right", {Side::kRight}, {{Side::kRight}, {Side::kLeft}}},
             {" left", {Side::kLeft}, {{Side::kLeft}, {Side::kRight}}}};
  }
  for (const Part& part : parts) {
    const std::vector<std::string> bodies = findBodies(*lines.front(), part.own);
    if (bodies.empty()) {
      continue;
    }
    std::size_t found = 0;
    for (const std::vector<Side>& sides : part.measured) {
      for (const MeasurementLine* line : lines) {
        std::optional<MeasurementSpec> measurement = makeMeasurement(*line, sides);
        if (!measurement) {
          continue;
        }
        const bool borrowed = sides != part.own;
        measurement->name =
            group + part.suffix + ": " + line->reason + (borrowed ? " of the other side" : "");
        measurement->alternative_of = group + part.suffix;
        measurement->bodies = bodies;
        for (const GroupLimit& limit : groupLimits()) {
          if (limit.group == group) {
            measurement->limit =
                FactorLimit{limit.beside + part.suffix, limit.min_ratio, limit.max_ratio};
          }
        }
        if (found++ == 0 && (line != lines.front() || borrowed)) {
          result_.notes.push_back(group + part.suffix + " is measured by \"" + line->reason +
                                  "\": markers for \"" + lines.front()->reason + "\" are missing");
        }
        result_.set.measurements.push_back(std::move(*measurement));
      }
    }
    if (found == 0) {
      result_.notes.push_back("no marker pair measures " + group + part.suffix);
    }
  }
}

FitTasks Builder::makeTasks(const MarkerTrajectories& trial, bool is_static) {
  std::map<std::string, int> bony, seen;
  for (const Placed& placed : placed_) {
    if (trial.findMarker(placed.marker) && placed.mark->kind != LandmarkKind::kTechnical) {
      ++bony[placed.body];
    }
  }
  FitTasks tasks;
  for (const Placed& placed : placed_) {
    const LandmarkKind kind = placed.mark->kind;
    // Clusters are wherever they are: before they were placed they say something only where
    // nothing else does.
    const bool idle = is_static ? kind == LandmarkKind::kTechnical && bony[placed.body] > 0
                                : kind == LandmarkKind::kDerived;
    if (!trial.findMarker(placed.marker) || idle || isOnHead(*placed.mark)) {
      continue;
    }
    tasks.markers.push_back(
        {placed.marker, is_static ? calcStaticWeight(*placed.mark) : calcIkWeight(*placed.mark)});
    ++seen[placed.body];
  }
  holdUnseenCoordinates(seen, tasks);
  return tasks;
}

void Builder::holdUnseenCoordinates(const std::map<std::string, int>& seen, FitTasks& tasks) {
  for (const JointSpec& joint : input_.model.joints) {
    const bool is_root = joint.parent.body == "ground";
    const auto found = seen.find(joint.child.body);
    const bool is_shown = found != seen.end() && found->second >= kMarkersOfABody;
    for (const CoordinateSpec& coordinate : joint.coordinates) {
      if (findMotionKind(joint, coordinate.name) != MotionKind::kRotational) {
        continue;
      }
      if (is_root) {
        // Any heading: the range of a model's pelvis rotation may end at a quarter turn.
        tasks.ranges.push_back({coordinate.name});
      } else if (!is_shown) {
        tasks.coordinates.push_back({coordinate.name, kHoldingWeight, {}});
      }
    }
  }
}

void Builder::addPlacements() {
  for (std::size_t i = 0; i < input_.static_poses.size(); ++i) {
    PlacementSpec placement;
    placement.range = still_[i].range;
    placement.min_visible_fraction = kMinVisiblePlacement;
    placement.tasks = makeTasks(input_.static_poses[i], true);
    require(!placement.tasks.markers.empty(),
            ErrorCode::kInputMarkers,
            "none of the markers of a static trial is a known landmark");
    result_.set.placements.push_back(std::move(placement));
  }
}

void Builder::addIk() {
  result_.set.ik = makeTasks(input_.movement, false);
  // A marker that no static trial shows was never placed.
  std::string list;
  for (const MarkerWeight& marker : result_.set.ik.markers) {
    const bool is_placed =
        std::any_of(input_.static_poses.begin(), input_.static_poses.end(), [&](const auto& pose) {
          return pose.findMarker(marker.marker).has_value();
        });
    if (!is_placed && !input_.static_poses.empty()) {
      list += (list.empty() ? "" : ", ") + marker.marker;
    }
  }
  if (!list.empty()) {
    result_.warnings.push_back("not used, since no static trial shows where they sit: " + list);
  }
}

}  // namespace

AutomaticMarkerSet makeAutomaticMarkerSet(const AutomaticSetInput& input) {
  return Builder(input).make();
}

}  // namespace gaitmill

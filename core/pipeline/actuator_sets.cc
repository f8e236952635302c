#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/where.h"
#include "core/pipeline/model_coordinates.h"
#include "core/pipeline/settings.h"

namespace gaitmill {

ActuatorSetSettings makeTrackingActuators() {
  ActuatorSetSettings set;
  set.residuals = ActuatorSetSettings::Residuals();
  set.residuals->optimal_force = 1.5;
  set.residuals->optimal_moment = 1;
  set.residuals->control_limit = 1e9;
  set.name_suffix = "";
  set.control_limit = 1;
  set.others = OtherCoordinates::kAll;
  set.other_optimal_force = 500;
  // As strong as the published ones (spec/rra.md 5): they never meet their limit in gait.
  for (const char* leg_or_trunk : {"hip_flexion",
                                   "hip_adduction",
                                   "hip_rotation",
                                   "knee_angle",
                                   "ankle_angle",
                                   "lumbar_extension",
                                   "lumbar_bending",
                                   "lumbar_rotation"}) {
    set.coordinates[leg_or_trunk] = 1000;
  }
  for (const char* arm : {"arm_flex", "arm_add", "arm_rot", "elbow_flex", "pro_sup"}) {
    set.coordinates[arm] = 500;
  }
  return set;
}

ActuatorSetSettings makeReserveActuators() {
  ActuatorSetSettings set;
  set.residuals = ActuatorSetSettings::Residuals();
  // The published set-ups give hip rotation 10 N.m; runners of automatic marker sets then leave up to
  // 26 % of its moment to the reserve, with 5 N.m 20 %.
  set.coordinates = {{"hip_flexion", 2.5},
                     {"hip_adduction", 5},
                     {"hip_rotation", 5},
                     {"knee_angle", 2.5},
                     {"ankle_angle", 2.5}};
  set.others = OtherCoordinates::kMuscles;
  return set;
}

CoordinateValues makeTrackingWeights() {
  // After the second pass of the published walking trial (spec/rra.md 5); ankle and trunk tighter.
  return {{"pelvis_tx", 200},
          {"pelvis_ty", 200},
          {"pelvis_tz", 150},
          {"pelvis_tilt", 600},
          {"pelvis_list", 800},
          {"pelvis_rotation", 50},
          {"hip_flexion", 300},
          {"hip_adduction", 95},
          {"hip_rotation", 50},
          {"knee_angle", 100},
          {"ankle_angle", 25},
          {"lumbar_extension", 75},
          {"lumbar_bending", 50},
          {"lumbar_rotation", 25},
          {"arm_flex", 3},
          {"arm_add", 3},
          {"arm_rot", 1},
          {"elbow_flex", 3},
          {"pro_sup", 1}};
}

std::map<std::string, double> expandSides(const CoordinateValues& values, const ModelSpec& model) {
  std::map<std::string, double> expanded;
  std::vector<std::string> names;
  for (const JointSpec& joint : model.joints) {
    for (const CoordinateSpec& coordinate : joint.coordinates) {
      names.push_back(coordinate.name);
    }
  }
  const auto known = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  // Names of both sides first, so that an entry for one side replaces its half.
  for (const auto& [name, value] : values) {
    if (!known(name)) {
      const std::string nearest = findNearestName(name, names);
      require(known(name + "_r") && known(name + "_l"),
              ErrorCode::kInputCoordinates,
              "the model has no coordinate '" + name + "'" +
                  (nearest.empty() ? "" : "; the nearest is '" + nearest + "'"),
              atCoordinate(name));
      expanded[name + "_r"] = value;
      expanded[name + "_l"] = value;
    }
  }
  for (const auto& [name, value] : values) {
    if (known(name)) {
      expanded[name] = value;
    }
  }
  return expanded;
}

namespace {

/// A model may be without residuals and then has every joint tracked alone.
constexpr const char* kUsualBase = "pelvis";

double findListed(const CoordinateValues& listed, const std::string& coordinate, double usual) {
  const auto own = listed.find(coordinate);
  if (own != listed.end()) {
    return own->second;
  }
  const std::size_t length = coordinate.size();
  const std::string suffix = length > 2 ? coordinate.substr(length - 2) : "";
  const auto both = listed.find(coordinate.substr(0, length - suffix.size()));
  return (suffix == "_r" || suffix == "_l") && both != listed.end() ? both->second : usual;
}

/// Optimal forces by coordinate.
std::map<std::string, double> fitForces(const ActuatorSetSettings& settings,
                                        const std::string& base,
                                        const ModelSpec& model) {
  if (settings.others == OtherCoordinates::kNone) {
    return expandSides(settings.coordinates, model);
  }
  std::map<std::string, double> forces;
  for (const ModelCoordinate& coordinate : listFreeCoordinates(model, base)) {
    const bool reached = settings.others == OtherCoordinates::kAll ||
                         (coordinate.has_muscle && !coordinate.has_actuator);
    const double usual = reached && !coordinate.at_root ? settings.other_optimal_force : 0;
    forces[coordinate.name] = findListed(settings.coordinates, coordinate.name, usual);
  }
  return forces;
}

/// Of coordinates that no list names: as the published weights of joints of their kind.
double findUsualWeight(const ModelCoordinate& coordinate) {
  constexpr double kBase = 200;
  constexpr double kTrunk = 50;
  constexpr double kLimb = 20;
  constexpr double kMuchMass = 0.2;  // of the body's: a trunk, not an arm
  return coordinate.at_root ? kBase : coordinate.moved_share >= kMuchMass ? kTrunk : kLimb;
}

ActuatorSpec makeResidual(const ActuatorSetSettings::Residuals& residuals,
                          const std::string& base,
                          const ModelSpec& model,
                          int axis,
                          ActuatorSpec::Kind kind) {
  const bool force = kind == ActuatorSpec::Kind::kPoint;
  const int body = model.findBody(base);
  require(body >= 0,
          ErrorCode::kModelReference,
          "the residuals act on a body '" + base + "' that the model does not have",
          {{}, 0, 0, base});
  ActuatorSpec actuator;
  actuator.name = std::string(force ? "F" : "M") + "XYZ"[axis];
  actuator.kind = kind;
  actuator.body = base;
  actuator.point =
      residuals.point.value_or(model.bodies[static_cast<std::size_t>(body)].mass_center);
  actuator.direction = Eigen::Vector3d::Unit(axis);
  actuator.direction_in_ground = true;
  actuator.optimal_force = force ? residuals.optimal_force : residuals.optimal_moment;
  actuator.min_control = -residuals.control_limit;
  actuator.max_control = residuals.control_limit;
  return actuator;
}

/// Whether the base can move along (about) an axis. A base that is held in part, as in planar
/// models or single legs on a fixed pelvis, needs no residual there.
bool canMove(const std::vector<ModelCoordinate>& coordinates, bool translation, int axis) {
  return std::any_of(coordinates.begin(), coordinates.end(), [&](const auto& coordinate) {
    return coordinate.at_root && coordinate.translation == translation &&
           coordinate.root_axis == axis;
  });
}

void addResiduals(const ActuatorSetSettings& settings,
                  const std::string& base,
                  const ModelSpec& model,
                  std::vector<ActuatorSpec>& actuators) {
  const bool strict = settings.others == OtherCoordinates::kNone;
  const std::vector<ModelCoordinate> coordinates = listFreeCoordinates(model, base);
  for (const auto kind : {ActuatorSpec::Kind::kPoint, ActuatorSpec::Kind::kTorque}) {
    for (int axis = 0; axis < 3; ++axis) {
      if (strict || canMove(coordinates, kind == ActuatorSpec::Kind::kPoint, axis)) {
        actuators.push_back(makeResidual(*settings.residuals, base, model, axis, kind));
      }
    }
  }
}

}  // namespace

std::map<std::string, double> fitWeights(const RraSettings::Pass& pass, const ModelSpec& model) {
  if (pass.others == OtherCoordinates::kNone) {
    return expandSides(pass.weights, model);
  }
  std::map<std::string, double> weights;
  for (const ModelCoordinate& coordinate :
       listFreeCoordinates(model, findBase(kUsualBase, model))) {
    const bool reached = pass.others == OtherCoordinates::kAll || coordinate.has_muscle;
    const double usual = reached ? findUsualWeight(coordinate) : 0;
    weights[coordinate.name] = findListed(pass.weights, coordinate.name, usual);
  }
  return weights;
}

std::vector<TrackingTask> fitTasks(const RraSettings::Pass& pass, const ModelSpec& model) {
  constexpr double kLightSegment = 0.03;      // of the body's mass: less than a foot and its shank
  constexpr double kFastPositionGain = 1600;  // [1/s^2] as published for the subtalar joint
  constexpr double kFastVelocityGain = 80;    // [1/s]
  std::map<std::string, bool> is_light;
  if (pass.others != OtherCoordinates::kNone) {
    for (const ModelCoordinate& coordinate :
         listFreeCoordinates(model, findBase(kUsualBase, model))) {
      const bool listed = findListed(pass.weights, coordinate.name, -1) >= 0;
      is_light[coordinate.name] = !listed && coordinate.moved_share < kLightSegment;
    }
  }
  std::vector<TrackingTask> tasks;
  for (const auto& [coordinate, weight] : fitWeights(pass, model)) {
    TrackingTask task;
    task.coordinate = coordinate;
    task.weight = weight;
    if (is_light[coordinate]) {
      task.position_gain = kFastPositionGain;
      task.velocity_gain = kFastVelocityGain;
    }
    tasks.push_back(task);
  }
  return tasks;
}

std::vector<ActuatorSpec> makeActuators(const ActuatorSetSettings& settings,
                                        const ModelSpec& model) {
  std::vector<ActuatorSpec> actuators;
  std::string base = settings.residuals ? settings.residuals->body : kUsualBase;
  if (base == kUsualBase) {
    base = findBase(base, model);
  }
  if (settings.residuals) {
    addResiduals(settings, base, model, actuators);
  }
  const std::map<std::string, double> optimal = fitForces(settings, base, model);
  for (const JointSpec& joint : model.joints) {
    for (const CoordinateSpec& coordinate : joint.coordinates) {
      const auto found = optimal.find(coordinate.name);
      if (found == optimal.end() || found->second <= 0) {
        continue;
      }
      ActuatorSpec actuator;
      actuator.name = coordinate.name + settings.name_suffix;
      actuator.coordinate = coordinate.name;
      actuator.optimal_force = found->second;
      actuator.min_control = -settings.control_limit;
      actuator.max_control = settings.control_limit;
      actuators.push_back(actuator);
    }
  }
  return actuators;
}

}  // namespace gaitmill

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/where.h"
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
  set.coordinates = {{"hip_flexion", 2.5},
                     {"hip_adduction", 5},
                     {"hip_rotation", 10},
                     {"knee_angle", 2.5},
                     {"ankle_angle", 2.5}};
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

ActuatorSpec makeResidual(const ActuatorSetSettings::Residuals& residuals,
                          const ModelSpec& model,
                          int axis,
                          ActuatorSpec::Kind kind) {
  const bool force = kind == ActuatorSpec::Kind::kPoint;
  const int body = model.findBody(residuals.body);
  require(body >= 0,
          ErrorCode::kModelReference,
          "the residuals act on a body '" + residuals.body + "' that the model does not have",
          {{}, 0, 0, residuals.body});
  ActuatorSpec actuator;
  actuator.name = std::string(force ? "F" : "M") + "XYZ"[axis];
  actuator.kind = kind;
  actuator.body = residuals.body;
  actuator.point =
      residuals.point.value_or(model.bodies[static_cast<std::size_t>(body)].mass_center);
  actuator.direction = Eigen::Vector3d::Unit(axis);
  actuator.direction_in_ground = true;
  actuator.optimal_force = force ? residuals.optimal_force : residuals.optimal_moment;
  actuator.min_control = -residuals.control_limit;
  actuator.max_control = residuals.control_limit;
  return actuator;
}

}  // namespace

std::vector<ActuatorSpec> makeActuators(const ActuatorSetSettings& settings,
                                        const ModelSpec& model) {
  std::vector<ActuatorSpec> actuators;
  for (int axis = 0; settings.residuals && axis < 3; ++axis) {
    actuators.push_back(makeResidual(*settings.residuals, model, axis, ActuatorSpec::Kind::kPoint));
  }
  for (int axis = 0; settings.residuals && axis < 3; ++axis) {
    actuators.push_back(
        makeResidual(*settings.residuals, model, axis, ActuatorSpec::Kind::kTorque));
  }
  const std::map<std::string, double> optimal = expandSides(settings.coordinates, model);
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

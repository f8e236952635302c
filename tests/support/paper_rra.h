#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/rra/rra_options.h"

namespace gaitmill {

// Residual reduction of the two trials of Rajagopal et al. (2016) as published (spec/rra.md 4, 5).

/// Residual forces at a point of the pelvis and torques, ground axes, then one torque per joint.
struct PaperRraActuators {
  Eigen::Vector3d pelvis_point{0, 0, 0};
  double residual_force = 1;  ///< optimal force [N]
};

inline std::vector<ActuatorSpec> makePaperRraActuators(const PaperRraActuators& setup) {
  std::vector<ActuatorSpec> actuators;
  const char* const force_names[] = {"FX", "FY", "FZ"};
  const char* const moment_names[] = {"MX", "MY", "MZ"};
  for (int axis = 0; axis < 3; ++axis) {
    ActuatorSpec force;
    force.name = force_names[axis];
    force.kind = ActuatorSpec::Kind::kPoint;
    force.body = "pelvis";
    force.point = setup.pelvis_point;
    force.direction = Eigen::Vector3d::Unit(axis);
    force.optimal_force = setup.residual_force;
    actuators.push_back(force);
  }
  for (int axis = 0; axis < 3; ++axis) {
    ActuatorSpec moment;
    moment.name = moment_names[axis];
    moment.kind = ActuatorSpec::Kind::kTorque;
    moment.body = "pelvis";
    moment.reaction_body = "ground";
    moment.direction = Eigen::Vector3d::Unit(axis);
    moment.optimal_force = 1;
    actuators.push_back(moment);
  }
  const auto add = [&](const std::string& coordinate, double optimal_force) {
    ActuatorSpec torque;
    torque.name = coordinate;
    torque.kind = ActuatorSpec::Kind::kCoordinate;
    torque.coordinate = coordinate;
    torque.optimal_force = optimal_force;
    torque.min_control = -1;
    torque.max_control = 1;
    actuators.push_back(torque);
  };
  for (const std::string side : {"_r", "_l"}) {
    for (const char* joint :
         {"hip_flexion", "hip_adduction", "hip_rotation", "knee_angle", "ankle_angle"}) {
      add(joint + side, 1000);
    }
  }
  for (const char* joint : {"lumbar_extension", "lumbar_bending", "lumbar_rotation"}) {
    add(joint, 1000);
  }
  for (const std::string side : {"_r", "_l"}) {
    for (const char* joint : {"arm_flex", "arm_add", "arm_rot", "elbow_flex", "pro_sup"}) {
      add(joint + side, 500);
    }
  }
  return actuators;
}

/// Weights by name; a name that stands for both sides carries no _r or _l.
using TaskWeights = std::vector<std::pair<std::string, double>>;

inline std::vector<TrackingTask> makePaperTasks(const TaskWeights& weights) {
  const std::vector<std::string> two_sided = {"hip_flexion",
                                              "hip_adduction",
                                              "hip_rotation",
                                              "knee_angle",
                                              "ankle_angle",
                                              "arm_flex",
                                              "arm_add",
                                              "arm_rot",
                                              "elbow_flex",
                                              "pro_sup"};
  std::vector<TrackingTask> tasks;
  for (const auto& [name, weight] : weights) {
    bool both = false;
    for (const std::string& joint : two_sided) both = both || joint == name;
    if (both) {
      tasks.push_back({name + "_r", weight});
      tasks.push_back({name + "_l", weight});
    } else {
      tasks.push_back({name, weight});
    }
  }
  return tasks;
}

inline RraOptions makePaperWalkRra() {
  RraOptions options;
  options.lowpass_cutoff = 6;
  options.actuators = makePaperRraActuators({{-0.107324, 0.0155155, 0}, 1.5});
  options.passes = {{0.45,
                     1.80,
                     makePaperTasks({{"pelvis_tx", 700},
                                     {"pelvis_ty", 700},
                                     {"pelvis_tz", 700},
                                     {"pelvis_tilt", 200},
                                     {"pelvis_list", 175},
                                     {"pelvis_rotation", 25},
                                     {"hip_flexion", 100},
                                     {"hip_adduction", 45},
                                     {"hip_rotation", 50},
                                     {"knee_angle", 25},
                                     {"ankle_angle", 10},
                                     {"lumbar_extension", 100},
                                     {"lumbar_bending", 100},
                                     {"lumbar_rotation", 10},
                                     {"arm_flex", 5},
                                     {"arm_add", 10},
                                     {"arm_rot", 1},
                                     {"elbow_flex", 10},
                                     {"pro_sup", 1}})},
                    {0.45,
                     1.80,
                     makePaperTasks({{"pelvis_tx", 200},
                                     {"pelvis_ty", 200},
                                     {"pelvis_tz", 150},
                                     {"pelvis_tilt", 600},
                                     {"pelvis_list", 800},
                                     {"pelvis_rotation", 50},
                                     {"hip_flexion", 300},
                                     {"hip_adduction", 95},
                                     {"hip_rotation", 50},
                                     {"knee_angle", 100},
                                     {"ankle_angle", 5},
                                     {"lumbar_extension", 20},
                                     {"lumbar_bending", 30},
                                     {"lumbar_rotation", 10},
                                     {"arm_flex", 3},
                                     {"arm_add", 3},
                                     {"arm_rot", 1},
                                     {"elbow_flex", 3},
                                     {"pro_sup", 1}})}};
  return options;
}

inline RraOptions makePaperRunRra() {
  RraOptions options;
  options.lowpass_cutoff = 15;
  options.actuators = makePaperRraActuators({{-0.0699009, 0, 0}, 1});
  const TaskWeights upper_body = {{"ankle_angle", 25},
                                  {"lumbar_extension", 75},
                                  {"lumbar_bending", 50},
                                  {"lumbar_rotation", 25},
                                  {"arm_flex", 1},
                                  {"arm_add", 1},
                                  {"arm_rot", 1},
                                  {"elbow_flex", 1},
                                  {"pro_sup", 1}};
  const auto with = [&](TaskWeights weights) {
    weights.insert(weights.end(), upper_body.begin(), upper_body.end());
    return makePaperTasks(weights);
  };
  options.passes = {{0.833,
                     1.546,
                     with({{"pelvis_tx", 25},
                           {"pelvis_ty", 150},
                           {"pelvis_tz", 50},
                           {"pelvis_tilt", 750},
                           {"pelvis_list", 250},
                           {"pelvis_rotation", 50},
                           {"hip_flexion", 75},
                           {"hip_adduction", 50},
                           {"hip_rotation", 10},
                           {"knee_angle", 10}})},
                    {0.833,
                     1.546,
                     with({{"pelvis_tx", 25},
                           {"pelvis_ty", 250},
                           {"pelvis_tz", 50},
                           {"pelvis_tilt", 200},
                           {"pelvis_list", 150},
                           {"pelvis_rotation", 50},
                           {"hip_flexion", 75},
                           {"hip_adduction", 50},
                           {"hip_rotation", 10},
                           {"knee_angle", 10}})},
                    {0.82,
                     1.546,
                     with({{"pelvis_tx", 25},
                           {"pelvis_ty", 200},
                           {"pelvis_tz", 50},
                           {"pelvis_tilt", 100},
                           {"pelvis_list", 100},
                           {"pelvis_rotation", 50},
                           {"hip_flexion_r", 75},
                           {"hip_flexion_l", 25},
                           {"hip_adduction_r", 25},
                           {"hip_adduction_l", 50},
                           {"hip_rotation", 10},
                           {"knee_angle", 50}})}};
  return options;
}

}  // namespace gaitmill

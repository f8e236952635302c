#include "core/pipeline/model_coordinates.h"

#include <algorithm>
#include <cstddef>
#include <set>

namespace gaitmill {

namespace {

constexpr double kTorqueOptimalForce = 10;  // [N.m] Rajagopal et al. (2016)

using Bodies = std::set<std::string>;

const JointSpec* findJointOfChild(const ModelSpec& model, const std::string& body) {
  const auto found = std::find_if(model.joints.begin(), model.joints.end(), [&](const auto& joint) {
    return joint.child.body == body;
  });
  return found == model.joints.end() ? nullptr : &*found;
}

/// Joints from the base up to ground.
std::set<const JointSpec*> findRootJoints(const ModelSpec& model, const std::string& base) {
  std::set<const JointSpec*> joints;
  const JointSpec* joint = findJointOfChild(model, base);
  while (joint != nullptr && joints.insert(joint).second) {
    joint = findJointOfChild(model, joint->parent.body);
  }
  return joints;
}

/// The joint's child and all bodies beyond it.
Bodies findMovedBodies(const ModelSpec& model, const JointSpec& joint) {
  Bodies moved = {joint.child.body};
  for (bool grown = true; grown;) {
    grown = false;
    for (const JointSpec& other : model.joints) {
      if (moved.count(other.parent.body) > 0) {
        grown |= moved.insert(other.child.body).second;
      }
    }
  }
  return moved;
}

double sumMass(const ModelSpec& model, const Bodies& bodies) {
  double sum = 0;
  for (const BodySpec& body : model.bodies) {
    sum += bodies.count(body.name) > 0 ? body.mass : 0;
  }
  return sum;
}

bool crosses(const MuscleSpec& muscle, const Bodies& moved) {
  const auto isMoved = [&](const PathPointSpec& point) {
    return moved.count(point.body) > 0;
  };
  return std::any_of(muscle.path.begin(), muscle.path.end(), isMoved) &&
         !std::all_of(muscle.path.begin(), muscle.path.end(), isMoved);
}

bool isDriven(const ModelSpec& model, const std::string& coordinate) {
  return std::any_of(model.couplers.begin(), model.couplers.end(), [&](const auto& coupler) {
    return coupler.enforced && coupler.dependent == coordinate;
  });
}

/// The axis of a custom joint that the coordinate moves along or about, as the nearest of ground's.
int findAxis(const JointSpec& joint, const std::string& coordinate) {
  for (const TransformAxisSpec& axis : joint.axes) {
    if (axis.coordinate == coordinate) {
      Eigen::Index nearest = 0;
      axis.axis.cwiseAbs().maxCoeff(&nearest);
      return static_cast<int>(nearest);
    }
  }
  return -1;
}

}  // namespace

std::vector<ModelCoordinate> listFreeCoordinates(const ModelSpec& model, const std::string& base) {
  const std::set<const JointSpec*> root = findRootJoints(model, base);
  const double mass = model.calcTotalMass();
  std::vector<ModelCoordinate> coordinates;
  for (const JointSpec& joint : model.joints) {
    const Bodies moved = findMovedBodies(model, joint);
    for (const CoordinateSpec& coordinate : joint.coordinates) {
      if (coordinate.locked || isDriven(model, coordinate.name)) {
        continue;
      }
      ModelCoordinate entry;
      entry.name = coordinate.name;
      entry.translation = findMotionKind(joint, coordinate.name) == MotionKind::kTranslational;
      entry.at_root = root.count(&joint) > 0;
      entry.root_axis = entry.at_root ? findAxis(joint, coordinate.name) : -1;
      entry.moved_share = mass > 0 ? sumMass(model, moved) / mass : 0;
      entry.has_muscle =
          std::any_of(model.muscles.begin(), model.muscles.end(), [&](const MuscleSpec& muscle) {
            return crosses(muscle, moved);
          });
      entry.has_actuator =
          std::any_of(model.actuators.begin(), model.actuators.end(), [&](const auto& actuator) {
            return actuator.kind == ActuatorSpec::Kind::kCoordinate &&
                   actuator.coordinate == coordinate.name;
          });
      coordinates.push_back(entry);
    }
  }
  return coordinates;
}

std::string findBase(const std::string& asked, const ModelSpec& model) {
  std::string base = asked;
  std::size_t most = 0;
  for (const JointSpec& joint : model.joints) {
    if (joint.child.body == asked) {
      return asked;
    }
    if (joint.parent.body == "ground" && joint.coordinates.size() >= most) {
      most = joint.coordinates.size() + 1;
      base = joint.child.body;
    }
  }
  return base;
}

std::string findTrunk(const std::string& asked, const ModelSpec& model) {
  if (model.findBody(asked) >= 0 || model.bodies.empty()) {
    return asked;
  }
  return std::max_element(model.bodies.begin(),
                          model.bodies.end(),
                          [](const auto& a, const auto& b) { return a.mass < b.mass; })
      ->name;
}

std::vector<std::string> addTorqueActuators(ModelSpec& model) {
  std::vector<std::string> added;
  // Without muscles there is nothing to complete.
  if (model.muscles.empty()) {
    return added;
  }
  for (const ModelCoordinate& coordinate : listFreeCoordinates(model, findBase("pelvis", model))) {
    if (coordinate.at_root || coordinate.has_muscle || coordinate.has_actuator) {
      continue;
    }
    ActuatorSpec actuator;
    actuator.name = coordinate.name + "_torque";
    actuator.coordinate = coordinate.name;
    actuator.optimal_force = kTorqueOptimalForce;
    model.actuators.push_back(actuator);
    added.push_back(coordinate.name);
  }
  return added;
}

}  // namespace gaitmill

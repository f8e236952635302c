#include "core/model/topology.h"

#include <cstddef>

#include "core/base/error.h"

namespace gaitmill {

namespace {

BodyIndex findBodyIndex(const Topology& topology,
                        const std::string& name,
                        const std::string& user) {
  if (name == "ground") {
    return kGround;
  }
  const auto found = topology.body_numbers.find(name);
  if (found == topology.body_numbers.end()) {
    std::vector<std::string> names;
    for (const auto& [known, number] : topology.body_numbers) {
      names.push_back(known);
    }
    const std::string nearest = findNearestName(name, names);
    throw Error(ErrorCode::kModelReference,
                user + " refers to a body '" + name + "' that the model does not have" +
                    (nearest.empty() ? "" : "; the nearest is '" + nearest + "'"),
                {{}, 0, 0, name});
  }
  return BodyIndex(found->second);
}

void numberBodies(const ModelSpec& spec, Topology& topology) {
  for (std::size_t i = 0; i < spec.bodies.size(); ++i) {
    const std::string& name = spec.bodies[i].name;
    require(topology.body_numbers.emplace(name, static_cast<int>(i)).second && name != "ground",
            ErrorCode::kModelDuplicateName,
            "two bodies are named '" + name + "'",
            {{}, 0, 0, name});
  }
}

void numberCoordinates(const ModelSpec& spec, Topology& topology) {
  for (std::size_t j = 0; j < spec.joints.size(); ++j) {
    const JointSpec& joint = spec.joints[j];
    Topology::Joint resolved;
    resolved.parent = findBodyIndex(topology, joint.parent.body, "joint '" + joint.name + "'");
    resolved.child = findBodyIndex(topology, joint.child.body, "joint '" + joint.name + "'");
    resolved.first_coordinate = static_cast<int>(topology.coordinate_names.size());
    resolved.coordinate_count = static_cast<int>(joint.coordinates.size());
    for (const CoordinateSpec& coordinate : joint.coordinates) {
      for (const std::string& earlier : topology.coordinate_names) {
        require(earlier != coordinate.name,
                ErrorCode::kModelDuplicateName,
                "two coordinates are named '" + coordinate.name + "'",
                {{}, 0, 0, coordinate.name});
      }
      topology.coordinate_names.push_back(coordinate.name);
      topology.joint_of_coordinate.push_back(static_cast<int>(j));
    }
    topology.joints.push_back(resolved);
  }
}

void assignChildren(const ModelSpec& spec, Topology& topology) {
  topology.joint_of_body.assign(spec.bodies.size(), -1);
  for (std::size_t j = 0; j < topology.joints.size(); ++j) {
    const std::string& name = spec.joints[j].name;
    const BodyIndex child = topology.joints[j].child;
    require(child.isValid(),
            ErrorCode::kModelTopology,
            "joint '" + name + "' has ground as its child; exchange parent and child",
            {{}, 0, 0, name});
    int& joint_of_child = topology.joint_of_body[static_cast<std::size_t>(child.value())];
    require(joint_of_child < 0,
            ErrorCode::kModelTopology,
            "body '" + spec.joints[j].child.body +
                "' is the child of two joints; kinematic loops are not "
                "supported",
            {{}, 0, 0, name});
    joint_of_child = static_cast<int>(j);
  }
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    require(topology.joint_of_body[b] >= 0,
            ErrorCode::kModelTopology,
            "body '" + spec.bodies[b].name + "' is not the child of any joint",
            {{}, 0, 0, spec.bodies[b].name});
  }
}

/// Attaches joints whose parent is placed until none is left; file order is arbitrary.
void orderOutward(const ModelSpec& spec, Topology& topology) {
  std::vector<bool> placed(spec.bodies.size(), false);
  topology.chain_of_body.resize(spec.bodies.size());
  bool progressed = true;
  while (topology.outward.size() < topology.joints.size() && progressed) {
    progressed = false;
    for (std::size_t j = 0; j < topology.joints.size(); ++j) {
      const Topology::Joint& joint = topology.joints[j];
      const auto child = static_cast<std::size_t>(joint.child.value());
      const bool ready =
          joint.parent == kGround || placed[static_cast<std::size_t>(joint.parent.value())];
      if (placed[child] || !ready) {
        continue;
      }
      if (joint.parent != kGround) {
        topology.chain_of_body[child] =
            topology.chain_of_body[static_cast<std::size_t>(joint.parent.value())];
      }
      for (int k = 0; k < joint.coordinate_count; ++k) {
        topology.chain_of_body[child].push_back(joint.first_coordinate + k);
      }
      placed[child] = true;
      topology.outward.push_back(static_cast<int>(j));
      progressed = true;
    }
  }
  require(topology.outward.size() == topology.joints.size(),
          ErrorCode::kModelTopology,
          "some bodies are not connected to ground: their joints form a loop");
}

}  // namespace

Topology makeTopology(const ModelSpec& spec) {
  Topology topology;
  numberBodies(spec, topology);
  numberCoordinates(spec, topology);
  assignChildren(spec, topology);
  orderOutward(spec, topology);
  return topology;
}

}  // namespace gaitmill

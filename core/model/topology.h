#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/index.h"
#include "core/data/model_spec.h"

namespace gaitmill {

/// Who hangs on whom: the joints of a ModelSpec resolved to a tree rooted at ground.
struct Topology {
  struct Joint {
    BodyIndex parent;
    BodyIndex child;
    int first_coordinate = 0;  ///< model number of the joint's first coordinate
    int coordinate_count = 0;
  };
  std::vector<Joint> joints;       ///< by spec joint
  std::vector<int> outward;        ///< joints from ground to the tips: parents first
  std::vector<int> joint_of_body;  ///< the joint whose child the body is
  std::vector<std::string> coordinate_names;
  std::vector<int> joint_of_coordinate;
  /// Coordinates that move a body, from ground outward.
  std::vector<std::vector<int>> chain_of_body;
  std::map<std::string, int> body_numbers;
};

/// @throws Error kModelReference, kModelTopology, kModelDuplicateName
Topology makeTopology(const ModelSpec& spec);

}  // namespace gaitmill

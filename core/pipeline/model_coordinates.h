#pragma once

#include <string>
#include <vector>

#include "core/data/model_spec.h"

namespace gaitmill {

/// A coordinate that moves by itself: neither locked nor driven by another.
struct ModelCoordinate {
  std::string name;
  bool translation = false;
  bool at_root = false;  ///< between ground and the base: what residuals are for
  /// Axis of ground that it moves the base along or about, 0 to 2; -1 where it is no root
  /// coordinate.
  int root_axis = -1;
  double moved_share = 0;     ///< mass beyond the joint over the whole mass
  bool has_muscle = false;    ///< some muscle crosses its joint
  bool has_actuator = false;  ///< of the model's own
};

/// In the model's order. @param base  body that residuals act on
std::vector<ModelCoordinate> listFreeCoordinates(const ModelSpec& model, const std::string& base);

/// `asked` if the model has it, else the child of the joint to ground with the most coordinates.
std::string findBase(const std::string& asked, const ModelSpec& model);

/// `asked` if the model has it, else its heaviest body.
std::string findTrunk(const std::string& asked, const ModelSpec& model);

/// Gives every joint that neither muscles nor actuators move (arms of models whose muscles end at
/// the trunk) torque actuators of 10 N.m optimal force like those of Rajagopal2016's own arms.
/// @returns their coordinates
std::vector<std::string> addTorqueActuators(ModelSpec& model);

}  // namespace gaitmill

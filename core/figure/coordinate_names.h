#pragma once

#include <string>
#include <vector>

namespace gaitmill {

/// How a coordinate, without its side, is called in figures; it names the positive direction.
struct CoordinateName {
  std::string base;     ///< "ankle_angle"
  std::string joint;    ///< "Ankle"
  std::string display;  ///< "Ankle dorsiflexion"
};

/// Of models with other names: the name itself, with spaces for underscores and a capital.
CoordinateName findCoordinateName(const std::string& base);

/// The names without side of the model of Rajagopal et al. (2016), from the pelvis to the hands.
const std::vector<CoordinateName>& knownCoordinates();

}  // namespace gaitmill

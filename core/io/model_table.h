#pragma once

#include <string>

#include "core/data/model_spec.h"

namespace gaitmill {

/// What is in a model, as text for people: counts and total mass; the muscles in the layout of
/// Table II of Rajagopal et al. (2016) (F0M [N], l0M and lsT [cm], * marks a rigid tendon, alpha0
/// [deg]; one row for both sides where left equals right to the last digit); bodies; coordinates
/// with their ranges [deg or m]; actuators.
std::string formatModelTable(const ModelSpec& spec);

/// Numbers of a model that its overview states.
struct ModelCounts {
  int bodies = 0;
  int joints = 0;
  int coordinates = 0;
  int coupled_coordinates = 0;  ///< dependent in an enforced coupler
  int locked_coordinates = 0;
  int muscles = 0;
  int rigid_tendons = 0;
  int actuators = 0;
  int wrap_cylinders = 0;
  int wrap_spheres = 0;
  int wrap_ellipsoids = 0;
  int passive_forces = 0;
  int markers = 0;
};
ModelCounts countModel(const ModelSpec& spec);

}  // namespace gaitmill

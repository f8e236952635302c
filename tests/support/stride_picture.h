#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/base/units.h"
#include "core/data/model_spec.h"
#include "core/io/files.h"
#include "core/render/picture.h"

namespace gaitmill {

/// Names and values of one row.
using NamedValues = std::vector<std::pair<std::string, double>>;

/// A table with the same values at 0 s and 1 s.
inline TimeSeries makeConstantTable(const NamedValues& row) {
  std::vector<std::string> labels;
  for (const auto& cell : row) labels.push_back(cell.first);
  TimeSeries table = makeTimeSeries("constant", labels, {0.0, 1.0});
  for (int i = 0; i < table.columnCount(); ++i) {
    table.values.col(i).setConstant(row[static_cast<std::size_t>(i)].second);
  }
  return table;
}

/// A subject of the project's own model early in the right leg's stance, with a force under the
/// right heel; no muscle values, no markers.
inline PictureData makeStridePicture() {
  PictureData data;
  data.model_osim = readFile("models/rajagopal2016/rajagopal2016.osim");
  const auto deg = [](double angle) {
    return toRadians(angle);
  };
  data.kinematics = makeConstantTable({{"pelvis_tx", 0.4},
                                       {"pelvis_ty", 0.92},
                                       {"pelvis_tilt", deg(-3)},
                                       {"hip_flexion_r", deg(24)},
                                       {"knee_angle_r", deg(8)},
                                       {"ankle_angle_r", deg(2)},
                                       {"hip_flexion_l", deg(-16)},
                                       {"knee_angle_l", deg(22)},
                                       {"ankle_angle_l", deg(-4)},
                                       {"lumbar_extension", deg(-4)},
                                       {"arm_flex_r", deg(-20)},
                                       {"arm_flex_l", deg(22)},
                                       {"elbow_flex_r", deg(20)},
                                       {"elbow_flex_l", deg(40)}});
  data.ground_reactions = makeConstantTable({{"right_fx", -90},
                                             {"right_fy", 700},
                                             {"right_fz", 20},
                                             {"right_px", 0.68},
                                             {"right_py", 0},
                                             {"right_pz", 0.09}});
  return data;
}

/// Adds muscle values to a picture: 0.1 for all but the right soleus, which is fully active.
inline void activateSoleus(const ModelSpec& model, PictureData& data) {
  NamedValues row;
  for (const MuscleSpec& muscle : model.muscles) {
    row.push_back({muscle.name, muscle.name == "soleus_r" ? 1.0 : 0.1});
  }
  data.muscle_values = makeConstantTable(row);
}

}  // namespace gaitmill

#pragma once

#include <string>
#include <vector>

namespace gaitmill {

/// Even stretch of some bodies of the generic model.
struct SegmentFactor {
  std::vector<std::string> bodies;
  double factor = 1;
};

/// Who walks the sample trial: invented, 70 kg and 1.76 m, every segment a little longer than the
/// generic model's 1.70 m so that scaling has something to find.
struct SamplePerson {
  double mass = 70.0;    ///< [kg]
  double height = 1.76;  ///< [m]
  std::vector<SegmentFactor> factors = {
      {{"pelvis", "torso"}, 1.02},
      {{"femur_r", "femur_l", "patella_r", "patella_l"}, 1.04},
      {{"tibia_r", "tibia_l"}, 1.03},
      {{"talus_r", "talus_l", "calcn_r", "calcn_l", "toes_r", "toes_l"}, 1.05},
      {{"humerus_r", "humerus_l", "ulna_r", "ulna_l", "radius_r", "radius_l", "hand_r", "hand_l"},
       1.02},
  };
};

}  // namespace gaitmill

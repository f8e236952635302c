#include "core/figure/coordinate_names.h"

#include "core/figure/muscle_names.h"

namespace gaitmill {

const std::vector<CoordinateName>& knownCoordinates() {
  static const std::vector<CoordinateName> names = {
      {"pelvis_tilt", "Pelvis", "Pelvis backward tilt"},
      {"pelvis_list", "Pelvis", "Pelvis list, right side down"},
      {"pelvis_rotation", "Pelvis", "Pelvis rotation, right side forward"},
      {"pelvis_tx", "Pelvis", "Pelvis forward"},
      {"pelvis_ty", "Pelvis", "Pelvis upward"},
      {"pelvis_tz", "Pelvis", "Pelvis to the right"},
      {"hip_flexion", "Hip", "Hip flexion"},
      {"hip_adduction", "Hip", "Hip adduction"},
      {"hip_rotation", "Hip", "Hip internal rotation"},
      {"knee_angle", "Knee", "Knee flexion"},
      {"ankle_angle", "Ankle", "Ankle dorsiflexion"},
      {"subtalar_angle", "Subtalar", "Subtalar inversion"},
      {"mtp_angle", "Toes", "Toe angle"},
      {"lumbar_extension", "Lumbar", "Lumbar extension"},
      {"lumbar_bending", "Lumbar", "Lumbar bending to the right"},
      {"lumbar_rotation", "Lumbar", "Lumbar rotation to the left"},
      {"arm_flex", "Shoulder", "Shoulder flexion"},
      {"arm_add", "Shoulder", "Shoulder adduction"},
      {"arm_rot", "Shoulder", "Shoulder internal rotation"},
      {"elbow_flex", "Elbow", "Elbow flexion"},
      {"pro_sup", "Forearm", "Forearm pronation"},
      {"wrist_flex", "Wrist", "Wrist flexion"},
      {"wrist_dev", "Wrist", "Wrist deviation"},
  };
  return names;
}

CoordinateName findCoordinateName(const std::string& base) {
  for (const CoordinateName& known : knownCoordinates()) {
    if (known.base == base) {
      return known;
    }
  }
  const std::string display = findMuscleName(base).display;
  return {base, display, display};
}

}  // namespace gaitmill

#include "core/validation/isometric_moments.h"

namespace gaitmill {

IsometricMoments calcIsometricMoments(const PosedMuscles& posed, CoordinateIndex coordinate) {
  IsometricMoments moments;
  for (int i = 0; i < posed.model().muscleCount(); ++i) {
    const MuscleIndex m(i);
    const double arm = posed.findMomentArm(m, coordinate);
    if (arm == 0) {
      continue;
    }
    // Activation 0 is raised to the muscle's minimum.
    const double passive = arm * posed.calcForce(m, 0).passive;
    const double active = arm * posed.calcForce(m, 1).total;
    moments.passive += passive;
    moments.positive += arm > 0 ? active : passive;
    moments.negative += arm < 0 ? active : passive;
  }
  return moments;
}

}  // namespace gaitmill

#pragma once

#include "core/base/index.h"
#include "core/validation/posed_muscles.h"

namespace gaitmill {

/// What the muscles can do about one coordinate in one pose [N.m]; positive turns it forwards.
struct IsometricMoments {
  double passive = 0;   ///< of all stretched fibers, at the lowest activation
  double positive = 0;  ///< agonists of the positive direction at activation 1, passive force of
                        ///< the others
  double negative = 0;  ///< the same for the negative direction; usually < 0
};

/// Sums over the muscles of the pose that `posed` is in; each in static equilibrium at zero
/// velocity (spec/paper_metrics.md H).
IsometricMoments calcIsometricMoments(const PosedMuscles& posed, CoordinateIndex coordinate);

}  // namespace gaitmill

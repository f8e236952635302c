#pragma once

#include "core/muscle/muscle.h"

namespace gaitmill {

/// A muscle of unit size with the default curves of its kind, for tests of what only needs curves.
inline Muscle makeMuscleOfUnitSize(MuscleKind kind) {
  MuscleSpec spec;
  spec.name = "unit";
  spec.kind = kind;
  spec.max_isometric_force = 1;
  spec.optimal_fiber_length = 1;
  spec.tendon_slack_length = 1;
  return makeMuscles({spec}).front();
}

}  // namespace gaitmill

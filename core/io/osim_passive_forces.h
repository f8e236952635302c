#pragma once

#include <vector>

#include "core/data/model_spec.h"
#include "core/io/osim_element.h"
#include "core/io/osim_frames.h"

namespace gaitmill {

// Forces that a model document applies by itself. Internal to core/io.

/// True for the types that PassiveForceSpec knows.
bool isPassiveForce(const OsimElement& force);

/// Degrees of limit forces become radians. The force's own offset frames are added to `frames`.
/// @throws Error kModelValue (an expression, a transition of 0), kModelReference, kModelElement
PassiveForceSpec readPassiveForce(const OsimElement& force,
                                  OsimFrames& frames,
                                  const std::vector<JointSpec>& joints);

}  // namespace gaitmill

#pragma once

#include <string>
#include <vector>

#include "core/data/model_spec.h"
#include "core/io/osim_element.h"
#include "core/io/osim_frames.h"

namespace gaitmill {

// Wrap objects, muscles and ideal actuators of a model document. Internal to core/io.

/// @throws Error kModelUnsupported for tori, kModelValue
WrapObjectSpec readWrapObject(const OsimElement& element);

/// True for the types of muscles that can be simulated.
bool isMuscle(const OsimElement& force);

/// @param muscle        an element for which isMuscle() is true
/// @param wrap_objects  names of all wrap objects of the model
/// @throws Error kMuscleParameter, kModelReference, kModelUnsupported, kModelValue
MuscleSpec readMuscle(const OsimElement& muscle,
                      const OsimFrames& frames,
                      const std::vector<JointSpec>& joints,
                      const std::vector<std::string>& wrap_objects);

/// True for the three types of ideal actuators (and their names in old documents).
bool isActuator(const OsimElement& force);

ActuatorSpec readActuator(const OsimElement& actuator,
                          const OsimFrames& frames,
                          const std::vector<JointSpec>& joints);

/// False if the document switched this force off.
bool isApplied(const OsimElement& force);

}  // namespace gaitmill

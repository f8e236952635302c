#pragma once

#include <string>

#include "core/base/error.h"

namespace gaitmill {

/// Places in the computation, for instance require(ok, code, message, atMuscle(spec.name)).
Where atTime(double seconds);
Where atMarker(const std::string& name);
Where atMuscle(const std::string& name);
Where atCoordinate(const std::string& name);

}  // namespace gaitmill

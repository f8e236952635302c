#pragma once

#include <vector>

#include "core/data/marker_trajectories.h"
#include "core/intake/marker_names.h"

namespace gaitmill {

// Where the markers are, as a check of what their names say.

/// Recordings are in metres with Y up; heading and place do not matter. Missing markers are NaN.
///
/// Holds a mapping against the positions and takes confidence from what contradicts them, so that
/// it is not used any more: markers of one pair on each other's side, all sides exchanged (told
/// from toes and heels, front and back of pelvis and trunk; a mirrored file looks the same), fronts
/// behind backs, and heights in the wrong order (a heel above a knee; arms are left out). What
/// somebody stated is warned of and kept. Every finding is a warning with its numbers.
void checkMarkerGeometry(const std::vector<const MarkerTrajectories*>& recordings,
                         MarkerMapping& mapping);

}  // namespace gaitmill

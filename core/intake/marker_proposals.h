#pragma once

#include <vector>

#include "core/data/marker_trajectories.h"
#include "core/intake/marker_names.h"

namespace gaitmill {

/// Proposes landmarks for markers whose names say nothing, from where they are in the frame of the
/// recordings in which most markers are seen: a standing person of the generic proportions is
/// turned, scaled and moved until the bony landmarks of both agree best, with arms hanging or
/// raised to the side. Markers already known hold it in place. A landmark is proposed to the
/// nearest marker within 10 cm, with a confidence of at most 0.3 that falls with the distance: for
/// somebody to confirm. Recordings are in metres with Y up. Does nothing below eight markers in a
/// frame.
void proposeLandmarks(const std::vector<const MarkerTrajectories*>& recordings,
                      MarkerMapping& mapping);

}  // namespace gaitmill

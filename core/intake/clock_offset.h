#pragma once

#include <optional>

#include "core/data/decision.h"
#include "core/data/ground_reaction.h"
#include "core/data/marker_trajectories.h"
#include "core/intake/laboratory.h"

namespace gaitmill {

/// How the clocks of forces and markers fit together.
struct ClockOffset {
  double offset = 0;       ///< [s] to be added to the times of the forces
  double correlation = 0;  ///< at the best offset
  double correlation_at_zero = 0;
  bool is_clear = false;  ///< good enough to act upon
};

/// Compares the vertical acceleration of the body's markers with the sum of all vertical forces:
/// by Newton's law they are the same curve. Both are low-passed alike; the lag with the largest
/// correlation within 0.15 s counts if it is at least 0.75 frames of the markers and the curves are
/// alike there (correlation 0.9), else there is none.
/// @param markers  in ground, @param reaction  in ground, on the subject
ClockOffset findClockOffset(const MarkerTrajectories& markers,
                            const BodyMarkers& body,
                            const GroundReaction& reaction);

/// Moves the times of the forces by what the settings say, else by what is found.
/// @param set  [s] of the settings
void decideClock(const MarkerTrajectories& markers,
                 const BodyMarkers& body,
                 const std::optional<double>& set,
                 GroundReaction& reaction,
                 Decisions& decisions);

}  // namespace gaitmill

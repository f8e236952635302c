#pragma once

#include <vector>

#include "core/data/ground_reaction.h"
#include "core/data/time_series.h"

namespace gaitmill {

/// Ground reaction of each foot, all plates it stands on together, as a laboratory reports it:
///   right_fx..fz  force on the subject                                                        [N]
///   right_px..pz  centre of pressure: where the force meets the floor with no moment but about
///                 the vertical; NaN below 20 N                                                [m]
///   right_my      that moment, 0 below 20 N [N.m]
/// and the same for left_, in ground axes. The floor is where the file's points of application lie.
/// @param feet        one per force; forces of no known foot are left out
/// @param start, end  rows inside [s]
/// @param least_step  rows closer to the last one kept are left out [s]
TimeSeries makeGroundReactionTable(const GroundReaction& reaction,
                                   const std::vector<Foot>& feet,
                                   double start,
                                   double end,
                                   double least_step);

}  // namespace gaitmill

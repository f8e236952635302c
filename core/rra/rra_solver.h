#pragma once

#include "core/base/progress.h"
#include "core/data/ground_reaction.h"
#include "core/data/time_series.h"
#include "core/rra/rra_options.h"
#include "core/rra/rra_result.h"

namespace gaitmill {

/// Residual reduction after Delp et al. (2007), IEEE TBME 54:1940, as spec/rra.md describes
/// OpenSim's. Each pass shifts the mass center of one body, simulates the model under torque
/// actuators that follow the desired motion, and changes the mass; the next pass follows the same
/// desired motion with the adjusted model. Muscles are carried along unused. Under the strategy
/// "autopilot" weights are found, see core/rra/rra_autopilot.h.
///
/// @param model        scaled model
/// @param coordinates  measured motion under plain coordinate names [rad|m]
/// @param reaction     ground reactions
/// @throws Error kSettingsValue, kInputTimeRange, kInputCoordinates, kModelReference, kTableShape
///   (motion of fewer than 100 rows after padding), kCancelled
RraResult solveRra(const ModelSpec& model,
                   const TimeSeries& coordinates,
                   const GroundReaction& reaction,
                   const RraOptions& options,
                   const Progress& progress = {});

/// Desired motion as the passes follow it: padded and filtered (spec/rra.md 1).
TimeSeries prepareDesiredMotion(const TimeSeries& coordinates, const RraOptions& options);

}  // namespace gaitmill

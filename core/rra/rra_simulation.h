#pragma once

#include "core/base/progress.h"
#include "core/model/external_loads.h"
#include "core/model/reference_motion.h"
#include "core/rra/rra_options.h"
#include "core/rra/rra_result.h"

namespace gaitmill {

/// One forward simulation of `model` under the tasks and over the time range of `result.used`
/// (spec/rra.md 3). Fills tables, statistics and counters of `result`; neither its adjustment nor
/// its adjusted model.
/// @throws Error kInputTimeRange, kInputCoordinates, kInputValue if the simulation diverges,
///   kCancelled
void simulatePass(const ModelSpec& model,
                  const ReferenceMotion& reference,
                  const ExternalLoads& loads,
                  const RraOptions& options,
                  const Progress& progress,
                  RraPassResult& result);

}  // namespace gaitmill

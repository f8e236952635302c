#pragma once

#include "core/base/progress.h"
#include "core/cmc/cmc_options.h"
#include "core/cmc/cmc_result.h"
#include "core/model/external_loads.h"
#include "core/model/model.h"
#include "core/model/reference_motion.h"

namespace gaitmill {

/// Computed muscle control after Thelen & Anderson (2006), J Biomech 39:1107, as spec/cmc.md
/// describes OpenSim's: a forward simulation of bodies and muscles in which, every 10 ms, constant
/// excitations are found that lead the coordinates back to the reference:
///   a* = udot_ref(t + window) + k_v (u_ref - u) + k_p (q_ref - q)
///   min sum (F/F^)^2  subject to  M a* + bias = arms^T F,  F_min <= F <= F_max
/// F are tendon forces, passive part included, that the muscles can reach within the window. A
/// window whose demand cannot be met is reported and the simulation goes on with the nearest
/// forces.
///
/// @param model      with the strengths and masses as they shall act
/// @param reference  motion to track, defined over the time range
/// @param loads      ground reactions
/// @throws Error kSettingsValue, kInputTimeRange, kModelReference, kMuscleParameter; kCancelled
CmcResult solveCmc(const Model& model,
                   const ReferenceMotion& reference,
                   const ExternalLoads& loads,
                   const CmcOptions& options,
                   const Progress& progress = {});

}  // namespace gaitmill

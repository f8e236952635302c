#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/model/external_loads.h"
#include "core/model/reference_motion.h"
#include "core/rra/rra_options.h"
#include "core/rra/rra_result.h"

namespace gaitmill {

/// Total mass and the adjusted body's mass center for which inverse dynamics of the desired motion
/// needs no vertical residual force and no residual moments about x and z on average. The averages
/// are affine in either, so that two or three Newton steps settle them (spec/rra.md 7); no
/// simulation. Within the limits of the options, in which case the averages become as small as they
/// may.
/// @param spec  in: as scaled; out: adjusted
/// @returns one entry per step: averages before and after, shift and mass change of the step
/// @throws what calcDesiredResiduals and findAdjustedBody throw
std::vector<MassAdjustment> fitMassAndCenter(const ReferenceMotion& motion,
                                             const ExternalLoads& loads,
                                             const RraOptions& options,
                                             const RraPassOptions& pass,
                                             ModelSpec& spec,
                                             const Progress& progress = {});

/// The steps as one adjustment.
MassAdjustment sumAdjustments(const std::vector<MassAdjustment>& steps);

}  // namespace gaitmill

#pragma once

#include "core/base/progress.h"
#include "core/model/external_loads.h"
#include "core/model/reference_motion.h"
#include "core/rra/rra_options.h"
#include "core/rra/rra_result.h"

namespace gaitmill {

/// Residuals that the desired motion needs, by inverse dynamics with the actuators at the motion's
/// rows from the last at or before the pass's start to the last at or before its end (spec/rra.md
/// 2).
/// Asks `progress` at every row whether to go on.
/// @throws Error kInputTimeRange if fewer than two rows lie in the range, kSettingsValue unless the
///   actuators are as many as the free coordinates
TimeSeries calcDesiredResiduals(const ModelSpec& spec,
                                const ReferenceMotion& motion,
                                const ExternalLoads& loads,
                                const RraOptions& options,
                                const RraPassOptions& pass,
                                const Progress& progress = {});

/// The body whose mass center may move. @throws Error kModelReference
BodySpec& findAdjustedBody(const RraOptions& options, ModelSpec& spec);

/// Mass-center shift and mass change that would bring the average moments about x and z and the
/// average vertical force to zero, as if the adjusted body were upright:
///   dx = Mz / W,  dz = -Mx / W,  W = m_body g;   dm = -Fy / g
/// Applies the shift to `spec`; not the mass, since the pass simulates with the old one.
MassAdjustment shiftMassCenter(const ReferenceMotion& motion,
                               const ExternalLoads& loads,
                               const RraOptions& options,
                               const RraPassOptions& pass,
                               ModelSpec& spec,
                               const Progress& progress = {});

}  // namespace gaitmill

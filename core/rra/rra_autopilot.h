#pragma once

#include "core/base/progress.h"
#include "core/model/external_loads.h"
#include "core/model/reference_motion.h"
#include "core/rra/rra_options.h"
#include "core/rra/rra_result.h"

namespace gaitmill {

/// What all passes of a residual reduction share. References outlive it.
struct RraTrial {
  const ModelSpec& model;
  const ReferenceMotion& reference;
  const ExternalLoads& loads;
  RraPassOptions first;  ///< time range within the motion, weights to start from
  RraLimits limits;      ///< resolved
};

/// Residual reduction that finds its own way (spec/rra.md 7). Mass and mass center come first, in
/// closed form from inverse dynamics (core/rra/mass_fit.h); every pass then simulates that model
/// and follows the same motion. From pass to pass a coordinate that strays further than its limit
/// gets a larger weight; where residuals exceed theirs, coordinates that stay far within their
/// limits get smaller ones. A pass is as good as its merit is small: the sum, over RMS and peak of
/// every coordinate's deviation and every residual, of the share by which it exceeds its limit. A
/// pass that is no better is taken back and tried with half the change; after two in a row, or as
/// many passes as the options allow, the best pass is kept.
///
/// @param result  out: passes with what was changed and why, the one to keep, steps of mass and
/// mass
///   center, warnings that name the likely cause where limits do not hold
/// @throws Error as solveRra
void runAutopilot(const RraTrial& trial,
                  const RraOptions& options,
                  const Progress& progress,
                  RraResult& result);

}  // namespace gaitmill

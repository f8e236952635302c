#pragma once

#include <string>
#include <vector>

#include "core/data/ground_reaction.h"
#include "core/data/time_series.h"
#include "core/rra/rra_options.h"
#include "core/rra/rra_result.h"

namespace gaitmill {

/// The limits with that of the residual force's peak raised to its share of the largest vertical
/// ground reaction.
RraLimits resolveLimits(const RraLimits& limits, const GroundReaction& reaction);

/// Deviations column by column; columns in "m" are translations, the others rotations.
std::vector<CoordinateDeviation> calcDeviations(const TimeSeries& errors, const RraLimits& limits);

/// A figure of a pass against its limit.
struct LimitedFigure {
  std::string name;  ///< "pelvis_ty RMS", "FX peak"
  double value = -1;
  double limit = -1;
  std::string unit;  ///< "deg", "cm", "N", "N.m": what the numbers count in
  double share() const { return value / limit; }
};

/// RMS and peak of all deviations, then of the six residuals.
std::vector<LimitedFigure> listFigures(const RraPassResult& pass, const RraLimits& limits);

/// Sum over all figures of the share by which each exceeds its limit.
double calcMerit(const std::vector<LimitedFigure>& figures);

/// Deviations, merit and the sentence of a pass that was not searched for but listed.
void assessPass(const RraLimits& limits, RraPassResult& pass);

}  // namespace gaitmill

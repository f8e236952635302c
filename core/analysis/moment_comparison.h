#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/analysis/gait_cycle.h"
#include "core/data/time_series.h"

namespace gaitmill {

/// A joint moment of the paper's comparison and its sign there (spec/paper_metrics.md C): hip
/// flexion, knee extension and ankle plantarflexion are positive.
struct ComparedMoment {
  std::string coordinate;  ///< "knee_angle_r"
  double sign = 1;         ///< multiplies the generalized force
};

/// The right hip, knee and ankle.
const std::vector<ComparedMoment>& paperMoments();

/// How far the net moment of the muscles lies from the one of inverse dynamics over a gait cycle.
/// Fields are NaN if the records share no instant of the cycle.
struct MomentComparison {
  std::string coordinate;
  int instants = 0;                        ///< samples compared
  double rmse;                             ///< C1: sqrt(mean (ID - muscle)^2)  [N.m]
  double peak;                             ///< signed maximum of ID in the paper's sign [N.m]
  double rmse_percent_of_peak;             ///< C2
  double peak_difference;                  ///< C3: max |ID - muscle| [N.m]
  double peak_difference_percent_of_peak;  ///< C4
  /// C5: fraction of instants with |ID - muscle| <= 0.1 max(|ID|, 5 % of the peak |ID|): the
  /// paper's "at least 90 %" with a floor where the moment crosses zero.
  double fraction_at_90_percent;
  double worst_share;    ///< largest |ID - muscle| / max(|ID|, floor) [-]
  double worst_percent;  ///< where in the cycle [%]
};

/// Compares one moment on the grid of makeComparisonGrid over the time both records cover.
/// @param inverse_dynamics  column "<coordinate>_moment" [N.m]
/// @param muscle_moments    column "<coordinate>" or "<coordinate>_moment": sum over the muscles,
///                          reserves excluded [N.m]
/// @throws Error kTableUnknownLabel, kTableNoRows
MomentComparison compareMoments(const TimeSeries& inverse_dynamics,
                                const TimeSeries& muscle_moments,
                                const ComparedMoment& moment,
                                const GaitCycle& cycle,
                                std::optional<int> seam_percent = std::nullopt);

/// Fraction of all (moment, instant) pairs that satisfy the 90 % rule; NaN without any.
double calcFractionAt90Percent(const std::vector<MomentComparison>& moments);

}  // namespace gaitmill

#pragma once

#include <optional>

#include "core/data/marker_set.h"
#include "core/model/marker_fit.h"

namespace gaitmill {

/// What scaling is asked for (spec/scale.md).
struct ScaleOptions {
  MarkerSetSpec marker_set;  ///< markers, measurements, manual factors, placements
  double subject_mass = 0;   ///< [kg]; 0 keeps the model's
  MarkerFitOptions fit;      ///< tolerances of the static fit

  /// Share of the frames in which both markers of a pair must be visible.
  double min_visible_fraction = 0.8;

  // Beyond these the result carries a warning (spec/scale.md 4, 7).
  double warn_factor_min = 0.7;
  double warn_factor_max = 1.4;
  double warn_pair_ratio = 1.06;  ///< largest over smallest pair factor of one measurement
  double warn_rms = 0.01;         ///< [m] of the static fit
  double warn_max = 0.02;         ///< [m] of one weighted marker

  /// Overrides for every muscle; absent = as the model document says.
  std::optional<double> max_contraction_velocity;  ///< [optimal fiber lengths / s]
  std::optional<double> fiber_damping;             ///< [-]

  /// @throws Error kInputValue naming the first option out of range
  void validate() const;
};

}  // namespace gaitmill

#pragma once

#include <string>

#include "core/data/time_series.h"

namespace gaitmill {

/// How closely one kinematics follows another (spec/paper_metrics.md A and B): largest values over
/// coordinates. NaN where there is no coordinate of that kind.
struct TrackingError {
  double max_deg;              ///< largest |e| of any rotation [deg]
  double max_cm;               ///< largest |e| of any translation [cm]
  double max_rms_deg;          ///< largest RMS over time of any rotation [deg]
  double max_rms_centiradian;  ///< the same times 100 in rad: what the published script prints as
                               ///< degrees
  double max_rms_cm;           ///< largest RMS over time of any translation [cm]
  std::string worst_rotation;  ///< coordinate of max_rms_deg
  std::string worst_translation;            ///< coordinate of max_rms_cm
  std::string worst_peak_rotation = {};     ///< coordinate of max_deg
  std::string worst_peak_translation = {};  ///< coordinate of max_cm
};

/// Statistics of a table of errors q_reference - q; every row weighs the same. A column is a
/// translation if its unit is "m" or, without units, its name ends in _tx, _ty or _tz; else a
/// rotation [rad]. @throws Error kTableNoRows
TrackingError calcTrackingError(const TimeSeries& errors);

/// Table of errors reference - actual at the rows of `actual`, for the columns that both have, the
/// reference interpolated linearly. Rows outside the reference's time are left out.
TimeSeries calcDifference(const TimeSeries& reference, const TimeSeries& actual);

}  // namespace gaitmill

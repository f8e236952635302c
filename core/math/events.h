#pragma once

#include <vector>

#include "core/data/time_series.h"

namespace gaitmill {

/// Times on the ground of one foot.
struct Contact {
  double strike = 0;        ///< [s] upward crossing; the record's start if it begins loaded
  double toe_off = 0;       ///< [s] downward crossing; the record's end if it ends loaded
  bool has_strike = false;  ///< the strike lies inside the record
  bool has_toe_off = false;
};

/// Rules for finding contacts in a vertical force (spec/signal.md 7.1).
struct ContactOptions {
  double threshold = 20;          ///< [N]; 5 for forces already set to zero off the ground
  double minimum_duration = 0.1;  ///< [s] shorter contacts are dropped; 0.3 walking, 0.1 running
  double maximum_gap = 0.05;      ///< [s] shorter losses of contact are ignored
  double minimum_rise = 0.025;    ///< [s] above the threshold before a crossing counts
};

/// Contacts in time order, crossings by linear interpolation between samples.
/// @param time      [s] non-decreasing
/// @param vertical  [N] upward on the subject, one per time
std::vector<Contact> findContacts(const std::vector<double>& time,
                                  const Eigen::Ref<const Eigen::VectorXd>& vertical,
                                  const ContactOptions& options = {});

/// One gait cycle, strike to strike of the same foot [s].
struct GaitCycle {
  double start = 0;
  double end = 0;
};

/// A table over 0..100 % of the cycle in steps of 1 (`time` holds the percentage), by linear
/// interpolation between rows. Percentages that the table does not reach stay NaN, unless its rows
/// beyond 100 % (or before 0 %) cover them: those are moved by one cycle, as the published figures
/// of the walking trial do with 100..125 %. Where both cover a percentage the row inside the cycle
/// counts. The seam shows a small jump, which is left as it is (spec/signal.md 8).
/// @throws Error kInputTimeRange if the cycle is empty
TimeSeries normalizeToCycle(const TimeSeries& table, const GaitCycle& cycle);

}  // namespace gaitmill

#pragma once

#include <string>
#include <vector>

#include "core/analysis/emg_channels.h"
#include "core/analysis/gait_cycle.h"
#include "core/data/time_series.h"

namespace gaitmill {

/// One time that a muscle is on. Ends are NaN where the record does not show them, and both are if
/// the muscle is on all the time.
struct ActivityBurst {
  double onset = 0;   ///< [% of the cycle] in [0, 100)
  double offset = 0;  ///< [% of the cycle] in [0, 100); below the onset if 100 % lies between
};

/// How the measured activity of a muscle agrees in time with the simulated one over a gait cycle
/// (spec/paper_metrics.md D). Amplitudes of surface EMG are arbitrary: nothing here depends on
/// them. Figures that cannot be told are NaN.
struct EmgComparison {
  std::string channel;
  std::vector<std::string> muscles;  ///< whose mean activation is compared (D1)
  BodySide side = BodySide::kRight;
  int instants = 0;        ///< of the 100 whole percents of the cycle, those that both cover
  double emg_peak;         ///< over the cycle [unit of the recording]
  double activation_peak;  ///< over the cycle [-]
  double scale;            ///< D2: activation_peak / emg_peak; EMG is shown times this
  double rms_difference;   ///< of EMG times scale and activation, per activation_peak [-]
  /// D5. On is a value of at least 20 % of the peak; times on, off or not recorded below 3 % of the
  /// cycle do not count.
  double overlap;  ///< fraction of the instants at which both are on or both are off
  std::vector<ActivityBurst> emg_bursts;
  std::vector<ActivityBurst> simulated_bursts;
  /// Simulated minus measured, of the two bursts that have most of the cycle in common
  /// [% of the cycle] in [-50, 50).
  double onset_difference;
  double offset_difference;
  double correlation;          ///< largest circular cross-correlation, means subtracted, [-1, 1]
  double lag;                  ///< where it is [% of the cycle]; positive: the simulation is later
  double correlation_at_zero;  ///< the same without lag
};

/// Compares one channel with the mean activation of its muscles on the grid of makeComparisonGrid
/// over the time both records cover: what is recorded beyond the second strike stands for what is
/// missing behind the first. Correlations need 80 instants.
/// @param emg          envelopes; column `channel.column`
/// @param activations  by muscle (D3); muscles that it does not have are left out
EmgComparison compareEmg(const TimeSeries& emg,
                         const TimeSeries& activations,
                         const EmgChannel& channel,
                         const GaitCycle& cycle);

}  // namespace gaitmill

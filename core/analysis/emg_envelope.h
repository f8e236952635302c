#pragma once

#include <optional>

#include "core/data/time_series.h"
#include "core/math/filters.h"

namespace gaitmill {

/// What an EMG recording holds.
enum class EmgSource {
  kAuto,      ///< to be told from the signal, see findEmgSource
  kRaw,       ///< as the electrodes gave it
  kEnvelope,  ///< rectified and smoothed before
};

struct FrequencyBand {
  double low = 0;   ///< [Hz]
  double high = 0;  ///< [Hz]
};

/// From raw EMG to its envelope, in this order; steps without frequency are left out. The defaults
/// are the published chain (Rajagopal et al. 2016, appendix; spec/signal.md 3.1), whose cutoffs are
/// those of one pass. Its envelopes come out to the last printed digit with `ends` at kZeroStart.
struct EmgOptions {
  std::optional<FrequencyBand> band_pass = FrequencyBand{50, 500};  ///< zero-phase Butterworth
  int band_pass_order = 6;                  ///< of the design; twice as many poles
  std::optional<double> butterworth = 7.5;  ///< [Hz] zero-phase low-pass after rectification
  int butterworth_order = 4;
  std::optional<double> critically_damped = 15;  ///< [Hz] low-pass that follows
  int critically_damped_passes = 4;              ///< even; 4 = "fourth order"
  /// Of the critically damped filter. kZeroStart loses about one period of its cutoff at each end.
  EdgeTreatment ends = EdgeTreatment::kReflected;
};

struct EmgEnvelopes {
  TimeSeries envelopes;                ///< unit of the recording, NaN where it has no value
  EmgSource source = EmgSource::kRaw;  ///< kRaw or kEnvelope: what the recording was taken for
  double rate = 0;                     ///< [Hz] mean over the rows
  EmgOptions used;                     ///< as asked, the band lowered where the rate requires it
};

/// Mean rate of a recording [Hz]. @throws Error kInputValue below two rows
double calcRate(const TimeSeries& recording);

/// Raw or envelope. Raw EMG has its power at 20 to 500 Hz and crosses its mean some hundred times a
/// second (walking trial of the paper 219 to 337, running 99 to 221); envelopes, smoothed at a few
/// hertz, do so below ten times. More than 50 times, in the median channel, is raw. Recordings
/// below 200 Hz cannot hold raw EMG.
/// @throws Error kInputValue below two rows
EmgSource findEmgSource(const TimeSeries& recording);

/// Envelopes of all channels. What is an envelope already comes back as it is. Missing samples are
/// bridged by straight lines for the filters and are missing again afterwards.
/// @param recording  evenly spaced for raw EMG
/// @throws Error kInputValue (rows too uneven to filter, a cutoff beyond half the rate), below two
/// rows
EmgEnvelopes calcEmgEnvelopes(const TimeSeries& recording,
                              EmgSource source,
                              const EmgOptions& options);

}  // namespace gaitmill

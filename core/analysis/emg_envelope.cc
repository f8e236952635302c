#include "core/analysis/emg_envelope.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/text.h"

namespace gaitmill {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLowestRawRate = 200;      // [Hz]
constexpr double kLowestRawCrossings = 50;  // [1/s], see findEmgSource
// A band-pass edge beyond this share of the rate has no room to fall off (spec/signal.md 3.1).
constexpr double kHighestEdge = 0.45;
// Rows may lie this share of a step beside an even grid: printed times are rounded.
constexpr double kLargestUnevenness = 0.5;

/// Crossings of the mean per second; 0 for a channel without values.
double calcCrossings(const Eigen::Ref<const Eigen::VectorXd>& signal, double duration) {
  const Eigen::ArrayXd known = signal.array().isFinite().select(signal.array(), 0.0);
  const auto count = static_cast<double>(signal.array().isFinite().count());
  const double mean = count > 0 ? known.sum() / count : 0;
  int crossings = 0;
  double before = 0;
  for (const double sample : signal) {
    const double now = sample - mean;
    if (std::isfinite(now) && now != 0) {
      crossings += now * before < 0 ? 1 : 0;
      // The sign alone: a product of tiny values would vanish.
      before = now > 0 ? 1 : -1;
    }
  }
  return crossings / duration;
}

void requireEvenRows(const TimeSeries& recording, double rate) {
  for (int row = 0; row < recording.rowCount(); ++row) {
    const double time = recording.time[static_cast<std::size_t>(row)];
    const double steps = (time - recording.time.front()) * rate;
    require(std::abs(steps - row) <= kLargestUnevenness,
            ErrorCode::kInputValue,
            "raw EMG must be evenly spaced; the row at " + formatFixed(time, 6) + " s lies " +
                formatFixed(std::abs(steps - row), 1) + " samples beside an even grid of " +
                formatFixed(rate, 3) + " Hz");
  }
}

/// Replaces what is not finite by the straight line between its neighbours, level at the ends;
/// zero in a channel without values.
void bridgeGaps(RowMatrix::ColXpr signal) {
  Eigen::Index last_known = -1;
  for (Eigen::Index i = 0; i < signal.size(); ++i) {
    if (!std::isfinite(signal[i])) {
      continue;
    }
    for (Eigen::Index k = last_known + 1; k < i; ++k) {
      const double share = last_known < 0 ? 1.0
                                          : static_cast<double>(k - last_known) /
                                                static_cast<double>(i - last_known);
      const double start = last_known < 0 ? signal[i] : signal[last_known];
      signal[k] = start + share * (signal[i] - start);
    }
    last_known = i;
  }
  for (Eigen::Index k = last_known + 1; k < signal.size(); ++k) {
    signal[k] = last_known < 0 ? 0.0 : signal[last_known];
  }
}

/// The band lowered to what the rate holds. @throws Error kInputValue if nothing is left of it
FrequencyBand fitBand(FrequencyBand band, double rate) {
  band.high = std::min(band.high, kHighestEdge * rate);
  require(band.low < band.high,
          ErrorCode::kInputValue,
          "a recording of " + formatFixed(rate, 1) + " Hz holds nothing of the band above " +
              formatFixed(band.low, 1) + " Hz");
  return band;
}

void runChain(const EmgOptions& options, double rate, RowMatrix& signals) {
  if (options.band_pass) {
    filterZeroPhase(
        makeButterworthBandPass(
            options.band_pass_order, options.band_pass->low, options.band_pass->high, rate),
        signals);
  }
  signals = signals.cwiseAbs().eval();
  if (options.butterworth) {
    filterZeroPhase(makeButterworthLowPass(options.butterworth_order, *options.butterworth, rate),
                    signals);
  }
  if (options.critically_damped) {
    filterCriticallyDamped(
        options.critically_damped_passes, *options.critically_damped, rate, options.ends, signals);
  }
}

}  // namespace

double calcRate(const TimeSeries& recording) {
  require(recording.rowCount() >= 2 && recording.time.back() > recording.time.front(),
          ErrorCode::kInputValue,
          "a recording of EMG needs at least two rows");
  return static_cast<double>(recording.rowCount() - 1) /
         (recording.time.back() - recording.time.front());
}

EmgSource findEmgSource(const TimeSeries& recording) {
  if (calcRate(recording) < kLowestRawRate || recording.columnCount() == 0) {
    return EmgSource::kEnvelope;
  }
  const double duration = recording.time.back() - recording.time.front();
  std::vector<double> crossings;
  for (Eigen::Index column = 0; column < recording.values.cols(); ++column) {
    crossings.push_back(calcCrossings(recording.values.col(column), duration));
  }
  const auto middle = crossings.begin() + static_cast<std::ptrdiff_t>(crossings.size() / 2);
  std::nth_element(crossings.begin(), middle, crossings.end());
  return *middle > kLowestRawCrossings ? EmgSource::kRaw : EmgSource::kEnvelope;
}

EmgEnvelopes calcEmgEnvelopes(const TimeSeries& recording,
                              EmgSource source,
                              const EmgOptions& options) {
  EmgEnvelopes result;
  result.rate = calcRate(recording);
  result.source = source == EmgSource::kAuto ? findEmgSource(recording) : source;
  result.used = options;
  result.envelopes = recording;
  RowMatrix& values = result.envelopes.values;
  if (result.source == EmgSource::kRaw) {
    requireEvenRows(recording, result.rate);
    if (options.band_pass) {
      result.used.band_pass = fitBand(*options.band_pass, result.rate);
    }
    for (Eigen::Index column = 0; column < values.cols(); ++column) {
      bridgeGaps(values.col(column));
    }
    runChain(result.used, result.rate, values);
  }
  // What overflowed is no measurement either.
  values = (recording.values.array().isFinite() && values.array().isFinite())
               .select(values.array(), kNaN)
               .matrix()
               .eval();
  return result;
}

}  // namespace gaitmill

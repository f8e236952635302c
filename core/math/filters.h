#pragma once

#include <vector>

#include "core/data/time_series.h"

namespace gaitmill {

/// Second-order section: y_k = b0 x_k + b1 x_k-1 + b2 x_k-2 - a1 y_k-1 - a2 y_k-2.
struct FilterSection {
  double b0 = 1;
  double b1 = 0;
  double b2 = 0;
  double a1 = 0;
  double a2 = 0;
};

/// A filter as a cascade, and how many samples `filterZeroPhase` has to add at each end.
struct FilterCascade {
  std::vector<FilterSection> sections;
  int edge_length = 0;  ///< 3 (polynomial order + 1) samples
};

/// Whether the cutoff means -3 dB after both passes of a zero-phase filter, or after one.
enum class CutoffMeaning {
  kSinglePass,  ///< -6 dB at the cutoff in the end; the published chains
  kBothPasses,  ///< analog cutoff divided by (sqrt 2 - 1)^(1 / 2 order) (spec/signal.md 1)
};

/// Butterworth low-pass by the bilinear transform, unit gain at rest (spec/signal.md 1).
/// @param order   >= 1
/// @param cutoff  [Hz] in (0, rate / 2)
/// @param rate    [Hz]
/// @throws Error kInputValue
FilterCascade makeButterworthLowPass(int order,
                                     double cutoff,
                                     double rate,
                                     CutoffMeaning meaning = CutoffMeaning::kSinglePass);

/// Butterworth band-pass of design order n: 2n poles, unit gain at the geometric centre.
/// @throws Error kInputValue unless 0 < low < high < rate / 2
FilterCascade makeButterworthBandPass(int order, double low, double high, double rate);

/// Forward and backward over every column, without phase shift. Each column is extended by odd
/// reflection and each pass starts in the steady state of its first sample (spec/signal.md 1).
/// @param values  uniformly sampled, at least two rows, finite
void filterZeroPhase(const FilterCascade& filter, RowMatrix& values);

/// How a critically damped filter meets the ends of a record (spec/signal.md 2).
enum class EdgeTreatment {
  kZeroStart,  ///< the first two outputs of every pass are 0: published forces and EMG
  kReflected,  ///< odd reflection and steady-state start: new data
};

/// Critically damped low-pass of Robertson & Dowling (2003), J Electromyogr Kinesiol 13:569: one
/// double real pole per pass, no overshoot. `passes` alternate forward and backward: 2 is the
/// "second-order", 4 the "fourth-order" zero-lag filter; -3 dB at the cutoff after all of them.
/// @throws Error kInputValue unless passes is even and positive and 0 < cutoff < rate / 2
void filterCriticallyDamped(
    int passes, double cutoff, double rate, EdgeTreatment edges, RowMatrix& values);

}  // namespace gaitmill

#pragma once

#include <limits>
#include <optional>

namespace gaitmill {

/// How inverse dynamics reads its motion.
struct IdOptions {
  /// Low-pass of the coordinates [Hz]: third-order Butterworth forward and backward with reflected
  /// ends (spec/signal.md 5.1). None by default: the published trials come smooth from residual
  /// reduction.
  std::optional<double> lowpass_cutoff;

  /// Rows reported: from the last at or before `start_time` to the last at or before `end_time`
  /// [s].
  double start_time = -std::numeric_limits<double>::infinity();
  double end_time = std::numeric_limits<double>::infinity();

  /// @throws Error kSettingsValue naming the field
  void validate() const;
};

}  // namespace gaitmill

#pragma once

#include <string>

#include "core/data/time_series.h"

namespace gaitmill {

/// The results of one job, wherever they are kept. Tables are named as in PipelineResult; SI units
/// and radians.
class ResultSource {
 public:
  enum class Axis {
    kTime,   ///< [s]
    kCycle,  ///< `time` holds 0..100 % of the gait cycle
  };

  virtual ~ResultSource() = default;
  virtual bool has(const std::string& table, Axis axis) const = 0;
  /// Stays valid as long as the source. @throws Error kResultNotFound, kResultNotReady
  virtual const TimeSeries& table(const std::string& table, Axis axis) const = 0;
  /// The content of summary.json.
  virtual const std::string& summary() const = 0;
};

}  // namespace gaitmill

#pragma once

#include <optional>
#include <string>

#include "core/data/figure.h"
#include "core/figure/job_data.h"

namespace gaitmill {

/// A threshold that the summary of a job holds a figure against.
struct QualityLimit {
  double value = 0;    ///< in `unit`
  std::string unit;    ///< "N", "%"
  std::string source;  ///< "Hicks et al. 2015"
};

/// The first check of this name ("residual_force_peak"); empty if the job has none.
std::optional<QualityLimit> findLimit(const JobData& data, const std::string& check);

/// Draws a limit as a horizontal guide "<what>: <value unit>, <source>" at `factor` times its
/// value.
void addLimit(const JobData& data,
              const std::string& check,
              const std::string& what,
              double factor,
              Panel& panel);

}  // namespace gaitmill

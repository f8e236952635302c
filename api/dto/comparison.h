#pragma once

#include <string>

#include "core/data/comparison.h"

namespace gaitmill::api {

/// {"jobs": [labels], "axis": "gait_cycle", "tables": [{"name", "columns": [{"name", "unit",
/// "first_peak", "differences": [{"rms", "largest", "largest_percent", "peak"}]}]}], "quality":
/// [{"quantity", "values": [one per job]}]}: differences of the second job, the third, ... against
/// the first; SI units and radians, four significant digits, NaN as null.
std::string renderComparison(const Comparison& comparison);

}  // namespace gaitmill::api

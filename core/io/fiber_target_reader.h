#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/data/fiber_target.h"

namespace gaitmill {

/// Reads target fiber lengths for the calibration of tendons, a table with commas:
///   muscle,norm_fiber_length,fiber_length_m
///   soleus,0.785,
///   semimem_r,,0.0713
/// Columns in any order; one of the two lengths may be absent as a column, and exactly one is given
/// in each row: over optimal fiber length, or in metres. Both are > 0. Empty lines and lines that
/// begin with # are skipped. Faults of several rows are reported together.
/// @throws Error kTableLabels, kTableDuplicateLabel, kTableColumnCount, kTableNumber, kTableNoRows,
///   kInputValue, kFileEmpty, kFileNotTheData; with line and column
std::vector<FiberTarget> readFiberTargets(std::string_view bytes, const std::string& file_name);

}  // namespace gaitmill

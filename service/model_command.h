#pragma once

#include <string>

#include "core/data/model_spec.h"

namespace gaitmill {

/// What `gaitmill model` prints.
enum class ModelReport {
  kTable,  ///< core/io/model_table.h: Table II of the paper and the other parts, for people
  kJson,   ///< the same as one JSON object, keys with units, for programs
};

/// Reads a model document and describes it; ends in a newline. Warnings of the reader are part of
/// the JSON ("warnings") and of the table's end.
/// @throws Error of readFile and readOsim
std::string describeModel(const std::string& path, ModelReport report);

}  // namespace gaitmill

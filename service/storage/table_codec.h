#pragma once

#include <string>

#include "core/data/time_series.h"

namespace gaitmill {

/// A table as bytes and back, every double bit by bit: "GMT1", the length of a JSON header as 64
/// bits, the header {"name", "labels", "units", "rows"}, then time and values row by row, all
/// little-endian.
std::string encodeTable(const TimeSeries& table);
/// @throws Error kStorage if the bytes are not such a table
TimeSeries decodeTable(const std::string& bytes);

}  // namespace gaitmill

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/data/time_series.h"

namespace gaitmill {

/// An analog recording of raw counts, converted.
struct AncFile {
  TimeSeries signals;  ///< [V], all channels, force plates included
  double rate = 0;     ///< [Hz] as the header states it
  std::vector<std::string> warnings;
};

/// Whether bytes begin as an analog file does: with "File_Type:".
bool isAnc(std::string_view bytes);

/// Reads an analog file of raw counts (spec/formats.md 5.1): tab-separated pairs of key and value,
/// among them BitDepth, PreciseRate and Polarity; then lines that begin with Name, Rate [Hz] and
/// Range [mV], one cell per channel; then rows of time and counts, with a tab at the end or not.
///   volts = counts 2 range 10^-3 / 2^BitDepth
/// Empty cells are missing. A channel that is sampled at another rate than the file is dropped with
/// a warning: its cells do not stand at the times of their rows.
/// @throws Error kEmgHeader (a header line that is missing or makes no sense), kTableLabels,
/// kTableDuplicateLabel, kTableColumnCount, kTableNumber, kTableTimeOrder, kTableNoRows,
/// kFileEmpty, kFileNotTheData; with line and column. Faults of several rows are reported together.
AncFile readAnc(std::string_view bytes, const std::string& file_name);

}  // namespace gaitmill

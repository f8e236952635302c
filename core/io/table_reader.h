#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/data/model_spec.h"
#include "core/data/time_series.h"

namespace gaitmill {

/// A table file as it stands: values unconverted, so angles may still be degrees.
struct TableFile {
  TimeSeries table;
  bool in_degrees = false;      ///< what rotational coordinates, if any, are in
  bool degrees_stated = false;  ///< by the header; else guessed: .mot degrees, others radians
  std::vector<std::string> warnings;

  std::string file_name;
  int label_line = 0;              ///< line of the labels, from 1
  std::vector<int> label_columns;  ///< where each label of `table` begins in it, from 1
  std::vector<int> row_lines;      ///< line of each row
};

/// Reads a table over time (spec/formats.md 2 and 5.2):
///  - MOT and STO with the SIMM, version 1 and version 3 headers and their mixtures. Header counts
///    are not trusted; where they differ from the rows, a warning says so.
///  - tables without header, whose first line holds the labels: separated by commas (empty cells
///  are
///    missing values, labels may end in a unit as in "knee_angle_r [rad]") or by blanks and tabs.
/// The first column is the time [s]. Cells that read nan are missing. A row that repeats the time
/// of the row before is dropped with a warning.
/// @param file_name  for messages, and to tell .mot from .sto where the header states no angle unit
/// @throws Error kTableHeader, kTableLabels, kTableDuplicateLabel, kTableColumnCount, kTableNumber,
/// kTableTimeOrder, kTableNoRows, kFileEmpty, kFileNotTheData; with line and column. Faults of
/// several rows are reported together.
TableFile readTable(std::string_view bytes, const std::string& file_name);

/// Quantity that a column label names (spec/formats.md 2.3).
struct ColumnName {
  enum class Kind { kPlain, kValue, kSpeed, kActivation, kFiberLength };
  Kind kind = Kind::kPlain;
  std::string name;  ///< coordinate or muscle, without path and suffix
};

/// "/jointset/knee_r/knee_angle_r/value" -> {kValue, "knee_angle_r"}; "knee_angle_r_u" -> {kSpeed,
/// "knee_angle_r"}; a label without path or known suffix is kPlain.
ColumnName parseColumnName(const std::string& label);

/// The columns of `file` that are coordinates of the model, under their plain names, in SI units
/// and radians. Degrees are converted for rotational coordinates only: coupled ones (the patella)
/// are in radians even in files in degrees. A unit at the label ("knee_angle_r [deg]") beats the
/// header.
/// @param ignored  if given, labels that are no coordinates are left out and appended here; if
/// null,
///                 such a label is an error
/// @throws Error kTableUnknownLabel, kTableDuplicateLabel (two labels for one coordinate),
/// kInputCoordinates if not one column is a coordinate
TimeSeries toCoordinates(const TableFile& file,
                         const ModelSpec& model,
                         std::vector<std::string>* ignored = nullptr);

/// Unit of a coordinate's value: "rad" or "m". @throws Error kInputCoordinates
std::string findCoordinateUnit(const ModelSpec& model, const std::string& coordinate);

}  // namespace gaitmill

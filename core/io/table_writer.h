#pragma once

#include <string>
#include <vector>

#include "core/data/marker_trajectories.h"
#include "core/data/model_spec.h"
#include "core/data/time_series.h"

namespace gaitmill {

/// How angles leave the house. Only columns that name a rotational coordinate of `model` (or its
/// speed) are converted: coupled ones stay in radians, as OpenSim expects.
enum class AngleUnit { kRadians, kDegrees };

struct TableWriteOptions {
  AngleUnit angles = AngleUnit::kRadians;
  const ModelSpec* model = nullptr;  ///< for degrees; without it, the columns in rad and rad/s
  std::vector<std::string> notes;    ///< free lines of the header
};

/// A table as MOT or STO text, which OpenSim and readTable open: version 1 header, tabs, each
/// number as the shortest text that reads back as the same double, NaN where nothing was measured.
/// @throws Error kTableShape if labels, times and values do not fit each other, kInputValue if
/// degrees are asked for without a model or units
std::string writeTable(const TimeSeries& table, const TableWriteOptions& options = {});

/// The same as CSV: first row "time [s]" and "name [unit]" ("name [1]" if dimensionless, "name"
/// alone if the table states no units); missing values are empty cells. readTable reads it back.
/// Angles are in radians, or in degrees ("[deg]") for every column whose unit is rad and that names
/// a rotational coordinate.
std::string writeCsv(const TimeSeries& table, const TableWriteOptions& options = {});

/// Marker trajectories as TRC text in metres.
std::string writeTrc(const MarkerTrajectories& markers, const std::string& file_name);

}  // namespace gaitmill

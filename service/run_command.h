#pragma once

#include <ostream>

#include "service/command_line.h"
#include "service/pipeline_functions.h"

namespace gaitmill {

/// Folder of a run's result tables, each under its name in the API as a storage file (SI, radians).
inline constexpr const char* kTablesFolder = "tables";

/// Reads the files, runs the pipeline, writes each result file in one step, with tables, plots,
/// images and report.html (service/run_views.h), and prints a table of stages, seconds and quality
/// figures.
/// @param out       the table
/// @param progress  stages as they begin, and warnings
/// @throws Error of the files, the settings or a stage
void runOnFiles(const RunOptions& options,
                const PipelineFunctions& functions,
                std::ostream& out,
                std::ostream& progress);

/// The table of a summary.json: one row per stage with its processor seconds and frames, then one
/// row per quality figure.
std::string formatSummary(const std::string& summary_json);

}  // namespace gaitmill

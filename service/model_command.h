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

/// `gaitmill model calibrate`: slack lengths that give the fibers of a pose their target lengths.
struct CalibrateOptions {
  std::string path;     ///< model document; empty = the model that ships with gaitmill
  std::string targets;  ///< table of core/io/fiber_target_reader.h; empty = the model as it is
  std::string out;      ///< calibrated model document; empty = none
  std::string models;   ///< folder
};

/// Calibrates (core/validation/tendon_slack.h) and describes each muscle in a row: target
/// normalised fiber length, present and calibrated slack length, difference. Writes the calibrated
/// model if asked to.
/// @throws Error of readFile, readOsim, readFiberTargets, calibrateTendonSlack and writeFile
std::string calibrateModel(const CalibrateOptions& options);

}  // namespace gaitmill

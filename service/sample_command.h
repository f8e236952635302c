#pragma once

#include <ostream>

#include "service/command_line.h"

namespace gaitmill {

/// Generates the sample trial, bit for bit what ships in models/sample, writes it into a folder and
/// prints the names; on request also the truth it comes from.
/// @throws Error of the files
void writeSample(const SampleOptionsOnDisk& options, std::ostream& out);

}  // namespace gaitmill

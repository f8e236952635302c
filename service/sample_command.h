#pragma once

#include <ostream>

#include "service/command_line.h"

namespace gaitmill {

/// Writes the sample trial into a folder and prints the names: the recorded files as they ship, or
/// generated anew together with the truth they come from.
/// @throws Error of the files
void writeSample(const SampleOptionsOnDisk& options, std::ostream& out);

}  // namespace gaitmill

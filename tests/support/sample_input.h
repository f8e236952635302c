#pragma once

#include <string>

#include "core/io/files.h"
#include "core/pipeline/pipeline.h"

namespace gaitmill {

/// A file of the repository as a job's input, under its own name.
inline InputFile readInput(const std::string& path) {
  return {path.substr(path.rfind('/') + 1), readFile(path)};
}

/// The embedded sample trial as an upload.
inline TrialInput readSampleInput() {
  TrialInput input;
  input.static_markers = readInput("models/sample/static.trc");
  input.markers = readInput("models/sample/markers.trc");
  input.ground_reaction = readInput("models/sample/grf.mot");
  input.emg = readInput("models/sample/emg.sto");
  input.mass = 70;
  input.height = 1.76;
  return input;
}

}  // namespace gaitmill

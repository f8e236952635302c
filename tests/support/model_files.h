#pragma once

#include <string>

#include "core/data/model_spec.h"
#include "core/io/files.h"
#include "core/io/osim_reader.h"

namespace gaitmill {

/// Model document from a file, for tests that link core_io.
inline ModelSpec readModelFile(const std::string& path) { return readOsim(readFile(path), path); }

/// The project's own model.
inline ModelSpec readOwnModel() { return readModelFile("models/rajagopal2016/rajagopal2016.osim"); }

}  // namespace gaitmill

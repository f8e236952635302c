#pragma once

#include <string>

#include "core/data/model_spec.h"

namespace gaitmill {

/// The model as a document of version 40000 that OpenSim 4.x opens and readOsim reads back to the
/// same model, every number included (shortest text that reads back as the same double). Without
/// <defaults>, meshes and comments: each object states all its properties.
std::string writeOsim(const ModelSpec& spec);

}  // namespace gaitmill

#pragma once

#include <string>

namespace gaitmill {

/// Where the models, marker sets and settings are: `asked` if it is not empty, else the first that
/// exists of ./models, <folder of the program>/../../models (a build tree) and
/// <folder of the program>/../share/gaitmill/models (an installation).
/// @throws Error kFileNotFound naming the places
std::string findModelsFolder(const std::string& asked);

}  // namespace gaitmill

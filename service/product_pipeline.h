#pragma once

#include <string>

#include "service/pipeline_functions.h"

namespace gaitmill {

/// The real pipeline with the models, marker sets and settings of this folder, and the real file
/// readers and writers.
PipelineFunctions makeProductPipeline(const std::string& models_folder);

}  // namespace gaitmill

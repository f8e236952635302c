#pragma once

#include "service/pipeline_functions.h"

namespace gaitmill {

/// The real pipeline, file readers and writers.
PipelineFunctions makeProductPipeline();

}  // namespace gaitmill

#pragma once

#include <string>

#include "service/pipeline_functions.h"

namespace gaitmill {

/// Functions that stand in for the physics. The run goes through all six stages and obeys its
/// settings document:
///   {"steps": 10, "step_ms": 1, "fail_at": "rra", "warn": "…", "crash_at": "so", "deaf": true,
///    "gate": "/tmp/x/gate"}
/// steps per stage and their time, the stage that throws, a warning, the stage in which the process
/// kills itself, whether requests to stop are ignored, and a prefix of files: stage S begins when
/// the file "<gate>.S" is there. Every stage leaves a checkpoint and the file
/// "<stage>.txt"; ID leaves a first table "moments", CMC all tables. Results depend on the settings
/// only, however often a run was resumed.
PipelineFunctions makeFakePipeline();

/// The table "moments" of every fake job: three rows, columns in N.m and rad, one value missing.
TimeSeries makeFakeTable(const std::string& name);

}  // namespace gaitmill

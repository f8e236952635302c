#pragma once

#include <functional>
#include <string>

#include "api/dto/result.h"
#include "api/dto/trial.h"
#include "core/pipeline/pipeline.h"

namespace gaitmill {

using PipelineRunner = std::function<PipelineResult(
    const TrialInput& input, const InputFile& settings, const PipelineEvents& events)>;
using SettingsCheck = std::function<void(const InputFile& settings)>;
/// Reads every file of an upload; fills `files` and `warnings` of the view.
/// @throws Error of the parser that refuses a file
using TrialInspector = std::function<api::TrialView(const api::TrialUpload& upload)>;
using StoEncoder = std::function<std::string(const TimeSeries& table, api::AngleUnit angles)>;

/// What the service needs of the physics, so that its tests can put something quick in its place.
struct PipelineFunctions {
  PipelineRunner run;
  SettingsCheck check_settings;
  TrialInspector inspect;
  StoEncoder encode_sto;
};

}  // namespace gaitmill

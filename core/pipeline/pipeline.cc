#include "core/pipeline/pipeline.h"

#include <utility>

#include "core/base/error.h"
#include "core/pipeline/job.h"
#include "core/pipeline/settings.h"

namespace gaitmill {

Pipeline::Pipeline(std::string models_folder) : models_folder_(std::move(models_folder)) {}

void Pipeline::checkSettings(const InputFile& settings_json) const {
  readSettings(settings_json);
}

PipelineResult Pipeline::run(const TrialInput& input,
                             const InputFile& settings_json,
                             const PipelineEvents& events) const {
  Job job = openJob(input, settings_json, models_folder_, events);
  for (int i = 0; i < kStageCount; ++i) {
    const Stage stage = static_cast<Stage>(i);
    if (job.settings.runs(stage)) {
      runStage(stage, job);
    }
  }
  PipelineResult result;
  addTables(job, result);
  addFiles(job, result);
  const JobQuality quality = calcQuality(job);
  if (const std::optional<std::string> acceptance = makeAcceptanceText(job, quality)) {
    result.files["acceptance.txt"] = *acceptance;
  }
  result.summary_json = makeSummary(job, quality);
  result.files["summary.json"] = result.summary_json;
  result.warnings = job.warnings;
  return result;
}

}  // namespace gaitmill

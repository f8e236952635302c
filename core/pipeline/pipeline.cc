#include "core/pipeline/pipeline.h"

#include <utility>

#include "core/base/error.h"
#include "core/pipeline/checkpoint.h"
#include "core/pipeline/job.h"
#include "core/pipeline/settings.h"
#include "core/pipeline/source_hash.h"

namespace gaitmill {

Pipeline::Pipeline(std::string models_folder) : models_folder_(std::move(models_folder)) {}

void Pipeline::checkSettings(const InputFile& settings_json) const {
  readSettings(settings_json);
}

std::string Pipeline::defaultSettings() {
  return writeSettings(readSettings({"", "{}"}));
}

void Pipeline::checkInput(const TrialInput& input, const InputFile& settings_json) const {
  const PipelineSettings settings = readSettings(settings_json);
  checkParts(input, settings);
  const bool uses_marker_set = settings.runs(Stage::kScale) || settings.runs(Stage::kIk);
  if (uses_marker_set && !input.marker_set && !isAutomatic(input, settings)) {
    openMarkerSet(input, settings, models_folder_);
  }
}

namespace {

/// The stages of a job, in order.
std::vector<Stage> listStages(const PipelineSettings& settings) {
  std::vector<Stage> stages;
  for (int i = 0; i < kStageCount; ++i) {
    if (settings.runs(static_cast<Stage>(i))) {
      stages.push_back(static_cast<Stage>(i));
    }
  }
  return stages;
}

void collect(const StageOutcome& outcome, PipelineResult& result) {
  for (const auto& [name, bytes] : outcome.files) {
    result.files[name] = bytes;
  }
  for (const auto& [name, table] : outcome.tables) {
    result.tables[name] = table;
  }
  for (const auto& [name, table] : outcome.cycle_tables) {
    result.cycle_tables[name] = table;
  }
}

/// Computes one stage and tells of it.
void computeStage(Stage stage, Job& job, PipelineResult& result) {
  const std::size_t warnings_before = job.warnings.size();
  runStage(stage, job);
  StageOutcome outcome = makeOutcome(stage, job);
  collect(outcome, result);
  if (job.events->stage_done) {
    outcome.checkpoint = writeCheckpoint(stage, warnings_before, job);
    outcome.files["summary.json"] = makeSummary(job, calcQuality(job));
    job.events->stage_done(outcome);
  }
}

void addSummary(const Job& job, PipelineResult& result) {
  const JobQuality quality = calcQuality(job);
  if (const std::optional<std::string> acceptance = makeAcceptanceText(job, quality)) {
    result.files["acceptance.txt"] = *acceptance;
  }
  result.summary_json = makeSummary(job, quality);
  result.files["summary.json"] = result.summary_json;
  result.warnings = job.warnings;
}

}  // namespace

PipelineResult Pipeline::run(const TrialInput& input,
                             const InputFile& settings_json,
                             const PipelineEvents& events,
                             const std::vector<std::string>& checkpoints) const {
  Job job = openJob(input, settings_json, models_folder_, events, !checkpoints.empty());
  const std::vector<Stage> stages = listStages(job.settings);
  require(checkpoints.size() <= stages.size(),
          ErrorCode::kCheckpointUnusable,
          "there are more checkpoints than stages");
  PipelineResult result;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    if (i < checkpoints.size()) {
      readCheckpoint(stages[i], checkpoints[i], job);
      takeOver(stages[i], job);
      collect(makeOutcome(stages[i], job), result);
    } else {
      computeStage(stages[i], job, result);
    }
  }
  addSummary(job, result);
  return result;
}

const std::string& codeVersion() {
  static const std::string version =
      std::string(GAITMILL_VERSION) + " " + std::string(kCoreSourceHash).substr(0, 16);
  return version;
}

}  // namespace gaitmill

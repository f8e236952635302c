#include "service/job_estimates.h"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/pipeline/pipeline.h"

namespace gaitmill {

namespace {

using nlohmann::json;

// From what part of a stage on its own pace says more than the mean of other jobs.
constexpr double kTellingFraction = 0.05;

// The stages that the settings ask for, in order; all six where they do not say.
std::vector<std::string> listStages(const std::string& settings_json) {
  const json settings = json::parse(settings_json, nullptr, false);
  const json chosen = settings.is_object() ? settings.value("stages", json::object()) : json();
  const auto name = [&chosen](const char* field, Stage otherwise) {
    return chosen.is_object() && chosen.contains(field) && chosen[field].is_string()
               ? chosen[field].get<std::string>()
               : std::string(stageName(otherwise));
  };
  const std::string first = name("first", Stage::kScale);
  const std::string last = name("last", Stage::kCmc);
  std::vector<std::string> stages;
  for (int i = 0; i < kStageCount; ++i) {
    const std::string stage = stageName(static_cast<Stage>(i));
    if (!stages.empty() || stage == first) {
      stages.push_back(stage);
    }
    if (stage == last) {
      break;
    }
  }
  return stages;
}

std::optional<double> findMean(const std::vector<StageEstimate>& estimates,
                               const std::string& stage) {
  const auto found = std::find_if(estimates.begin(), estimates.end(), [&](const auto& estimate) {
    return estimate.stage == stage;
  });
  return found == estimates.end() ? std::nullopt : std::optional<double>(found->seconds);
}

double calcStageRest(const api::StageTiming& timing, double mean) {
  return timing.fraction > kTellingFraction
             ? timing.seconds * (1.0 - timing.fraction) / timing.fraction
             : std::max(mean - timing.seconds, 0.0);
}

}  // namespace

std::optional<double> calcSecondsLeft(const api::JobView& job,
                                      const std::vector<StageEstimate>& estimates,
                                      int workers) {
  if (api::isFinal(job.state)) {
    return std::nullopt;
  }
  double left = 0;
  double whole = 0;
  for (const std::string& stage : listStages(job.settings_json)) {
    const auto timing = std::find_if(job.stages.begin(), job.stages.end(), [&](const auto& begun) {
      return begun.stage == stage;
    });
    const std::optional<double> mean = findMean(estimates, stage);
    if (!mean && (timing == job.stages.end() || timing->fraction <= kTellingFraction)) {
      return std::nullopt;
    }
    whole += mean.value_or(0);
    left += timing == job.stages.end() ? *mean : calcStageRest(*timing, mean.value_or(0));
  }
  // The jobs ahead share the workers; each is taken to be as long as this one.
  const auto ahead = static_cast<double>(job.jobs_ahead.value_or(0));
  return left + whole * ahead / std::max(workers, 1);
}

JobEstimates::JobEstimates(Source source, int workers, std::chrono::milliseconds max_age)
    : source_(std::move(source)), workers_(workers), max_age_(max_age) {}

std::optional<double> JobEstimates::calcSecondsLeft(const api::JobView& job) {
  return api::isFinal(job.state) ? std::nullopt
                                 : gaitmill::calcSecondsLeft(job, findEstimates(), workers_);
}

std::vector<StageEstimate> JobEstimates::findEstimates() {
  const std::lock_guard<std::mutex> lock(guard_);
  const auto now = std::chrono::steady_clock::now();
  if (!asked_ || now - *asked_ >= max_age_) {
    estimates_ = source_();
    asked_ = now;
  }
  return estimates_;
}

}  // namespace gaitmill

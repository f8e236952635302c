#include "service/job_recorder.h"

#include <algorithm>
#include <utility>

namespace gaitmill {

namespace {

constexpr std::chrono::milliseconds kWriteInterval{250};

}  // namespace

JobRecorder::JobRecorder(std::vector<api::StageTiming> finished)
    : stages_(std::move(finished)), stage_began_(Clock::now()), written_() {}

bool JobRecorder::recordProgress(Stage stage, double fraction) {
  const bool is_new = enter(stage);
  const Clock::time_point now = Clock::now();
  stages_.back().seconds = std::chrono::duration<double>(now - stage_began_).count();
  stages_.back().fraction = std::clamp(fraction, stages_.back().fraction, 1.0);
  return is_new || now - written_ >= kWriteInterval;
}

void JobRecorder::recordStageEnd(Stage stage) {
  recordProgress(stage, 1.0);
}

void JobRecorder::recordWarning(const std::string& message) {
  if (std::find(warnings_.begin(), warnings_.end(), message) == warnings_.end()) {
    warnings_.push_back(message);
  }
}

std::vector<std::string> JobRecorder::newWarnings() const {
  return {warnings_.begin() + static_cast<std::ptrdiff_t>(written_warnings_), warnings_.end()};
}

void JobRecorder::markWritten() {
  written_ = Clock::now();
  written_warnings_ = warnings_.size();
}

// A job whose checkpoints turn out to be unusable begins anew: later stages are forgotten.
bool JobRecorder::enter(Stage stage) {
  const std::string name = stageName(stage);
  if (!stages_.empty() && stages_.back().stage == name) {
    return false;
  }
  const auto again = std::find_if(
      stages_.begin(), stages_.end(), [&](const auto& timing) { return timing.stage == name; });
  stages_.erase(again, stages_.end());
  if (!stages_.empty()) {
    stages_.back().fraction = 1.0;
  }
  stages_.push_back({name, 0.0, 0.0});
  stage_began_ = Clock::now();
  return true;
}

}  // namespace gaitmill

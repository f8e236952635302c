#include "service/job_recorder.h"

#include <algorithm>
#include <utility>

namespace gaitmill {

namespace {

constexpr std::chrono::milliseconds kWriteInterval{250};

}  // namespace

JobRecorder::JobRecorder(JobStore& store, JobTicket ticket)
    : store_(store), ticket_(std::move(ticket)), stage_began_(Clock::now()), written_() {}

bool JobRecorder::recordProgress(Stage stage, double fraction) {
  const bool is_new = stages_.empty() || stages_.back().stage != stageName(stage);
  const Clock::time_point now = Clock::now();
  if (is_new) {
    if (!stages_.empty()) {
      stages_.back().fraction = 1.0;
    }
    stages_.push_back({stageName(stage), 0.0, 0.0});
    stage_began_ = now;
  }
  stages_.back().seconds = std::chrono::duration<double>(now - stage_began_).count();
  stages_.back().fraction = std::clamp(fraction, stages_.back().fraction, 1.0);
  return is_new || now - written_ >= kWriteInterval ? write() : true;
}

void JobRecorder::recordWarning(const std::string& message) {
  warnings_.push_back(message);
}

bool JobRecorder::finish(const std::vector<std::string>& all_warnings) {
  for (const std::string& warning : all_warnings) {
    if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end()) {
      warnings_.push_back(warning);
    }
  }
  if (!stages_.empty()) {
    const auto now = Clock::now();
    stages_.back().seconds = std::chrono::duration<double>(now - stage_began_).count();
    stages_.back().fraction = 1.0;
  }
  return write();
}

bool JobRecorder::write() {
  written_ = Clock::now();
  const auto first_new = warnings_.begin() + static_cast<std::ptrdiff_t>(written_warnings_);
  written_warnings_ = warnings_.size();
  return store_.saveProgress(ticket_, stages_, {first_new, warnings_.end()});
}

}  // namespace gaitmill

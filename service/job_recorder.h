#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "api/dto/job.h"
#include "core/pipeline/pipeline.h"
#include "service/storage/job_store.h"

namespace gaitmill {

/// Keeps the stages, timings and warnings of one running job and says when its row is due to be
/// written: at once when a stage begins, otherwise at most every 250 ms, because solvers report
/// after every step. For the thread that runs the job.
class JobRecorder {
 public:
  /// @param finished  stages of earlier attempts
  explicit JobRecorder(std::vector<api::StageTiming> finished);

  /// @returns whether the row is due
  bool recordProgress(Stage stage, double fraction);
  void recordStageEnd(Stage stage);
  /// One that the job has said already is not repeated.
  void recordWarning(const std::string& message);

  const std::vector<api::StageTiming>& stages() const { return stages_; }
  /// Warnings that no write has taken along yet.
  std::vector<std::string> newWarnings() const;
  /// The row has been written with what stages() and newWarnings() said.
  void markWritten();

 private:
  using Clock = std::chrono::steady_clock;

  bool enter(Stage stage);

  std::vector<api::StageTiming> stages_;
  std::vector<std::string> warnings_;
  std::size_t written_warnings_ = 0;
  Clock::time_point stage_began_;
  Clock::time_point written_;
};

}  // namespace gaitmill

#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "api/dto/job.h"
#include "core/pipeline/pipeline.h"
#include "service/storage/job_store.h"

namespace gaitmill {

/// Keeps the stages, timings and warnings of one running job and writes them to its row: at once
/// when a stage begins, otherwise at most every 250 ms, because solvers report after every step.
/// For the thread that runs the job.
class JobRecorder {
 public:
  JobRecorder(JobStore& store, JobTicket ticket);

  /// @returns false if the ticket is void: the job is somebody else's now
  bool recordProgress(Stage stage, double fraction);
  void recordWarning(const std::string& message);
  /// Writes what has not been written, and warnings of the result that no event announced.
  bool finish(const std::vector<std::string>& all_warnings);

 private:
  using Clock = std::chrono::steady_clock;

  bool write();

  JobStore& store_;
  JobTicket ticket_;
  std::vector<api::StageTiming> stages_;
  std::vector<std::string> warnings_;
  std::size_t written_warnings_ = 0;
  Clock::time_point stage_began_;
  Clock::time_point written_;
};

}  // namespace gaitmill

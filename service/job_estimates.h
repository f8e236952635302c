#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "api/dto/job.h"
#include "service/storage/job_store.h"

namespace gaitmill {

/// How long a job will still take, from its own progress and from how long the stages of recent
/// jobs took. Safe from any thread.
class JobEstimates {
 public:
  /// Mean stage seconds of recent jobs: JobStore::calcStageEstimates, or a test.
  using Source = std::function<std::vector<StageEstimate>()>;
  static constexpr std::chrono::seconds kMaxAge{5};

  /// @param workers  jobs computed at a time
  JobEstimates(Source source, int workers, std::chrono::milliseconds max_age = kMaxAge);

  /// [s] from now to the end of the job; nothing if it has ended or nothing is known yet.
  std::optional<double> calcSecondsLeft(const api::JobView& job);

 private:
  std::vector<StageEstimate> findEstimates();

  Source source_;
  int workers_;
  std::chrono::milliseconds max_age_;
  std::mutex guard_;
  std::vector<StageEstimate> estimates_;
  std::optional<std::chrono::steady_clock::time_point> asked_;
};

/// The sum behind it.
/// @param estimates  of the stages in the order they run
std::optional<double> calcSecondsLeft(const api::JobView& job,
                                      const std::vector<StageEstimate>& estimates,
                                      int workers);

}  // namespace gaitmill

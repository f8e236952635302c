#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "service/pipeline_functions.h"
#include "service/storage/job_store.h"
#include "service/storage/trial_store.h"

namespace gaitmill {

/// Threads that claim queued jobs and run the pipeline on them, each with everything of its own.
/// Nothing that happens in a job ends its thread.
class Workers {
 public:
  Workers(TrialStore& trials, JobStore& jobs, PipelineRunner run, int count);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  void start();
  /// A job has been queued.
  void wake();
  /// Stops this job at its solver's next step, if it runs here.
  void cancel(const std::string& job_id);
  /// No new work; running jobs stop at their next step and go back to the queue.
  /// @returns false if a solver did not stop within `limit`: its job is back in the queue all the
  ///          same, but its thread still runs and the process must end without waiting for it
  bool stop(std::chrono::milliseconds limit);

 private:
  struct RunningJob {
    explicit RunningJob(JobTicket job_ticket) : ticket(std::move(job_ticket)) {}
    JobTicket ticket;
    std::atomic<bool> cancelled{false};
  };

  void work();
  bool claimAndRun();
  void runJob(const ClaimedJob& job);
  PipelineResult runPipelineOf(const ClaimedJob& job, const RunningJob& running);
  void settle(const RunningJob& running, const Error& error);
  std::shared_ptr<RunningJob> enlist(const JobTicket& ticket);
  void dismiss(const JobTicket& ticket);

  TrialStore& trials_;
  JobStore& jobs_;
  PipelineRunner run_;
  int count_;
  std::atomic<bool> stopping_{false};
  std::mutex guard_;
  std::condition_variable changed_;
  std::uint64_t submissions_ = 0;  ///< grows with every wake(), so that none is missed
  int active_ = 0;                 ///< threads that have not ended
  std::map<std::string, std::shared_ptr<RunningJob>> running_;
  std::vector<std::thread> threads_;
};

}  // namespace gaitmill

#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "service/job_run.h"

namespace gaitmill {

struct WorkersOptions {
  int count = 1;
  /// How often a free worker looks for jobs that other processes have submitted or left behind.
  std::chrono::milliseconds look_around{500};
  JobRunOptions runs;
};

/// Threads that claim jobs and run each in a child process. Nothing that happens in a job ends its
/// thread.
class Workers {
 public:
  /// @param stores, shipped, metrics  outlive this; metrics has declareJobMetrics()
  Workers(Stores& stores, const ShippedCatalog& shipped, Metrics& metrics, WorkersOptions options);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  void start();
  /// A job has been queued.
  void wake();
  /// Kills the solver of this job at once, if it runs here.
  void cancel(const std::string& job_id);
  /// No new work from now on. Returns at once.
  void beginStop();
  /// Running jobs may end by themselves within `limit`; then their solvers are killed and the jobs
  /// given back, without blame.
  /// @returns false if even that could not be stored in time: the leases then lapse by themselves,
  ///          and the process must end without waiting for its threads
  bool stop(std::chrono::milliseconds limit);

 private:
  void work();
  bool claimAndRun();
  std::shared_ptr<JobSignals> enlist(const std::string& job_id);
  void dismiss(const std::string& job_id, const std::shared_ptr<JobSignals>& signals);
  void killAll();

  Stores& stores_;
  const ShippedCatalog& shipped_;
  Metrics& metrics_;
  WorkersOptions options_;
  std::mutex guard_;
  std::condition_variable changed_;
  bool stopping_ = false;          ///< no new work
  bool killing_ = false;           ///< what runs is to be given back
  std::uint64_t submissions_ = 0;  ///< grows with every wake(), so that none is missed
  int active_ = 0;                 ///< threads that have not ended
  std::map<std::string, std::shared_ptr<JobSignals>> running_;
  std::vector<std::thread> threads_;
};

}  // namespace gaitmill

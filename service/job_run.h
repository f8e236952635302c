#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "service/job_input.h"
#include "service/job_recorder.h"
#include "service/observe/metrics.h"
#include "service/process/solver_process.h"
#include "service/stores.h"

namespace gaitmill {

/// How jobs are run by one process.
struct JobRunOptions {
  std::string owner;  ///< of the leases: "serve:<random>", "work:<random>"
  std::chrono::milliseconds lease{10'000};
  std::chrono::milliseconds heartbeat{2'000};
  /// A job whose results cannot be stored waits for so long, then it is given back.
  std::chrono::milliseconds park_limit{900'000};
  ChildCommand solver;  ///< starts a child that solves
  SolveLimits limits;   ///< its tick is how often a cancellation from elsewhere is looked for
};

/// What other threads want of a running job.
struct JobSignals {
  std::atomic<bool> cancelled{false};
  std::atomic<bool> stopping{false};  ///< kill the solver and give the job back
  Interrupt interrupt;                ///< raised after a change of the two
};

/// One claimed job from its claim to its end or hand-back: a solver in a child process, its stages
/// stored as they finish, the lease renewed meanwhile. Every write names the claim, so that a
/// process that was asleep past its lease changes nothing. For one thread.
class JobRun : private SolveListener {
 public:
  JobRun(Stores& stores,
         const ShippedCatalog& shipped,
         const JobRunOptions& options,
         Metrics& metrics,
         const ClaimedJob& job,
         JobSignals& signals);

  /// Never throws: what goes wrong becomes the end of the job, or of this attempt.
  void run() noexcept;

 private:
  /// Why the solver was stopped.
  enum class Stop { kNone, kCancelled, kStopping, kTicketLost, kParkedTooLong };

  // SolveListener
  void progress(Stage stage, double fraction) override;
  void warn(const std::string& sentence) override;
  void finish(SolvedStage stage) override;
  void print(const std::string& line) override;
  bool goesOn() override;

  void announceBegin();
  /// Nothing if the job has been given back.
  std::optional<SolveOutcome> attempt();
  SolveRequest readRequest();
  std::vector<std::string> readCheckpoints();
  void settle(const SolveOutcome& outcome);
  void settleSuccess(const SolveOutcome& outcome);
  void settleStop();
  void settleDeath(const Error& reason);
  void giveBack(const std::string& why);
  void saveProgress();
  /// Writes again and again until it works, the job is no longer wanted, or the park limit is over.
  /// @returns whether it was written and the ticket still holds
  bool writeStubbornly(const char* what, const std::function<bool()>& write);
  void renewLease();
  void lookAround();
  void observeSuccess(const std::vector<api::StageTiming>& stages);

  Stores& stores_;
  const ShippedCatalog& shipped_;
  const JobRunOptions& options_;
  Metrics& metrics_;
  const ClaimedJob& job_;
  JobSignals& signals_;
  JobRecorder recorder_;
  Stop stop_ = Stop::kNone;
  std::chrono::steady_clock::time_point renewed_;
  double trial_seconds_ = 0;  ///< [s] that the trial's movement lasts, 0 = unknown
};

/// Declares the metrics that runs count.
void declareJobMetrics(Metrics& metrics);

}  // namespace gaitmill

#include "service/job_run.h"

#include <algorithm>
#include <cstdint>
#include <thread>
#include <utility>

#include "core/base/error.h"
#include "service/observe/log.h"

namespace gaitmill {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kFirstRetry{100};
constexpr milliseconds kLongestRetry{2'000};

ResultKind kindOf(SolvedItem::Kind kind) {
  switch (kind) {
    case SolvedItem::Kind::kFile:
      return ResultKind::kFile;
    case SolvedItem::Kind::kTime:
      return ResultKind::kTime;
    case SolvedItem::Kind::kCycle:
      return ResultKind::kCycle;
    case SolvedItem::Kind::kSummary:
      return ResultKind::kSummary;
  }
  return ResultKind::kFile;
}

std::vector<ResultItem> makeItems(std::vector<SolvedItem> solved) {
  std::vector<ResultItem> items;
  for (SolvedItem& item : solved) {
    items.push_back({kindOf(item.kind), std::move(item.name), std::move(item.bytes), ""});
  }
  return items;
}

// How long the movement lasts, from what was understood of the trial [s].
double findTrialSeconds(const api::TrialView& trial) {
  for (const api::UnderstoodFile& file : trial.files) {
    if ((file.part == "markers" || file.part == "coordinates") && file.start && file.end) {
      return *file.end - *file.start;
    }
  }
  return 0;
}

}  // namespace

void declareJobMetrics(Metrics& metrics) {
  metrics.declareCounter("gaitmill_claims_total", "Jobs taken up by a worker.");
  metrics.declareCounter("gaitmill_job_retries_total", "Jobs taken up again after an attempt.");
  metrics.declareCounter("gaitmill_jobs_finished_total", "Jobs that have ended, by state.");
  metrics.declareCounter("gaitmill_job_deaths_total", "Attempts whose solver has died, by code.");
  metrics.declareCounter("gaitmill_jobs_given_back_total", "Attempts ended by a stop, by reason.");
  metrics.declareCounter("gaitmill_storage_retries_total", "Writes of results tried again.");
  metrics.declareHistogram("gaitmill_stage_seconds",
                           "Wall-clock time of finished stages.",
                           {0.01, 0.05, 0.1, 0.5, 1, 2, 5, 10, 30, 60, 120, 300, 900});
  metrics.declareHistogram("gaitmill_realtime_factor",
                           "Seconds of movement per second of computing, of succeeded jobs.",
                           {0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1, 3, 10});
}

JobRun::JobRun(Stores& stores,
               const ShippedCatalog& shipped,
               const JobRunOptions& options,
               Metrics& metrics,
               const ClaimedJob& job,
               JobSignals& signals)
    : stores_(stores),
      shipped_(shipped),
      options_(options),
      metrics_(metrics),
      job_(job),
      signals_(signals),
      recorder_(job.stages),
      renewed_(Clock::now()) {}

void JobRun::run() noexcept {
  try {
    announceBegin();
    if (const std::optional<SolveOutcome> outcome = attempt()) {
      settle(*outcome);
    }
  } catch (const std::exception& error) {
    // The lease lapses by itself, and the job is taken up again.
    logEvent(Severity::kError,
             "job.lost_sight",
             {{"job_id", job_.ticket.job_id}, {"message", error.what()}});
  }
}

void JobRun::announceBegin() {
  logEvent(Severity::kInfo,
           "job.begins",
           {{"job_id", job_.ticket.job_id},
            {"trial_id", job_.trial_id},
            {"tenant", job_.tenant},
            {"attempt", job_.ticket.claim},
            {"stages_done", static_cast<std::int64_t>(job_.stages.size())}});
  metrics_.add("gaitmill_claims_total");
  if (job_.ticket.claim > 1) {
    metrics_.add("gaitmill_job_retries_total");
  }
}

// What the storage refuses counts as a death, so that a damaged trial is not tried for ever; that
// the machine has no process left for now is no fault of the job.
std::optional<SolveOutcome> JobRun::attempt() {
  // A cancellation that came between the claim and this run has found nobody to tell.
  if (!goesOn()) {
    settleStop();
    return std::nullopt;
  }
  try {
    const SolveRequest request = readRequest();
    return solveInChild(options_.solver, request, options_.limits, *this, &signals_.interrupt);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kInternal) {
      std::this_thread::sleep_for(kLongestRetry);
      giveBack(error.what());
      return std::nullopt;
    }
    const bool is_storage = error.code() == ErrorCode::kStorage;
    return SolveOutcome{
        is_storage ? SolveOutcome::End::kDied : SolveOutcome::End::kFailed, {}, "", {}, error};
  }
}

SolveRequest JobRun::readRequest() {
  JobInput input = readJobInput(stores_, shipped_, job_);
  trial_seconds_ = findTrialSeconds(stores_.trials.find(job_.tenant, job_.trial_id));
  SolveRequest request;
  request.settings = {"settings", job_.settings_json};
  request.mass = input.mass;
  request.height = input.height;
  request.parts = std::move(input.parts);
  request.checkpoints = readCheckpoints();
  return request;
}

// Damaged checkpoints only cost their time.
std::vector<std::string> JobRun::readCheckpoints() {
  if (job_.stages.empty()) {
    return {};
  }
  try {
    return stores_.jobs.readCheckpoints(job_.ticket.job_id);
  } catch (const Error& error) {
    logEvent(Severity::kError,
             "job.checkpoints_unusable",
             {{"job_id", job_.ticket.job_id}, {"message", error.what()}});
    return {};
  }
}

void JobRun::progress(Stage stage, double fraction) {
  if (recorder_.recordProgress(stage, fraction) && stop_ == Stop::kNone) {
    saveProgress();
  }
}

void JobRun::warn(const std::string& sentence) {
  recorder_.recordWarning(sentence);
}

void JobRun::finish(SolvedStage stage) {
  if (stop_ != Stop::kNone) {
    return;
  }
  recorder_.recordStageEnd(stage.stage);
  FinishedStage finished{stageName(stage.stage),
                         std::move(stage.checkpoint),
                         makeItems(std::move(stage.items)),
                         recorder_.stages(),
                         recorder_.newWarnings()};
  const bool is_written =
      writeStubbornly("stage", [&] { return stores_.jobs.saveStage(job_.ticket, finished); });
  if (!is_written) {
    signals_.interrupt.raise();  // goesOn() has something to say
    return;
  }
  recorder_.markWritten();
  const double seconds = recorder_.stages().back().seconds;
  metrics_.observe("gaitmill_stage_seconds", {{"stage", finished.stage}}, seconds);
  logEvent(Severity::kInfo,
           "stage.done",
           {{"job_id", job_.ticket.job_id}, {"stage", finished.stage}, {"seconds", seconds}});
}

void JobRun::print(const std::string& line) {
  logEvent(Severity::kInfo, "solver.prints", {{"job_id", job_.ticket.job_id}, {"message", line}});
}

bool JobRun::goesOn() {
  lookAround();
  return stop_ == Stop::kNone;
}

// A storage that does not answer is no reason to stop computing; the fencing token keeps what is
// written later in order.
void JobRun::lookAround() {
  if (signals_.cancelled) {
    stop_ = Stop::kCancelled;
  } else if (signals_.stopping) {
    stop_ = Stop::kStopping;
  }
  if (stop_ != Stop::kNone) {
    return;
  }
  try {
    if (Clock::now() - renewed_ >= options_.heartbeat) {
      renewLease();
    } else {
      const TicketStanding standing = stores_.jobs.findStanding(job_.ticket);
      stop_ = !standing.is_held           ? Stop::kTicketLost
              : standing.cancel_requested ? Stop::kCancelled
                                          : Stop::kNone;
    }
  } catch (const Error& error) {
    logEvent(Severity::kWarn,
             "job.heartbeat_failed",
             {{"job_id", job_.ticket.job_id}, {"message", error.what()}});
  }
}

void JobRun::renewLease() {
  const TicketStanding standing = stores_.jobs.heartbeat(job_.ticket, options_.lease);
  renewed_ = Clock::now();
  stop_ = !standing.is_held           ? Stop::kTicketLost
          : standing.cancel_requested ? Stop::kCancelled
                                      : Stop::kNone;
}

// Progress may be lost: the next one says more.
void JobRun::saveProgress() {
  try {
    if (stores_.jobs.saveProgress(job_.ticket, recorder_.stages(), recorder_.newWarnings())) {
      recorder_.markWritten();
    } else {
      stop_ = Stop::kTicketLost;
      signals_.interrupt.raise();
    }
  } catch (const Error& error) {
    logEvent(Severity::kDebug,
             "job.progress_not_stored",
             {{"job_id", job_.ticket.job_id}, {"message", error.what()}});
  }
}

bool JobRun::writeStubbornly(const char* what, const std::function<bool()>& write) {
  const Clock::time_point give_up = Clock::now() + options_.park_limit;
  milliseconds pause = kFirstRetry;
  while (true) {
    try {
      const bool is_held = write();
      stop_ = is_held ? stop_ : Stop::kTicketLost;
      return is_held;
    } catch (const Error& error) {
      metrics_.add("gaitmill_storage_retries_total");
      logEvent(Severity::kError,
               "job.parked",
               {{"job_id", job_.ticket.job_id}, {"what", what}, {"message", error.what()}});
    }
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, kLongestRetry);
    lookAround();
    if (stop_ == Stop::kNone && Clock::now() >= give_up) {
      stop_ = Stop::kParkedTooLong;
    }
    if (stop_ != Stop::kNone) {
      return false;
    }
  }
}

void JobRun::settle(const SolveOutcome& outcome) {
  switch (outcome.end) {
    case SolveOutcome::End::kSucceeded:
      return settleSuccess(outcome);
    case SolveOutcome::End::kDied:
      return settleDeath(*outcome.error);
    case SolveOutcome::End::kStopped:
      return settleStop();
    case SolveOutcome::End::kFailed:
      break;
  }
  if (writeStubbornly("failure", [&] { return stores_.jobs.fail(job_.ticket, *outcome.error); })) {
    metrics_.add("gaitmill_jobs_finished_total", {{"state", "failed"}});
    logEvent(Severity::kWarn,
             "job.failed",
             {{"job_id", job_.ticket.job_id},
              {"code", codeName(outcome.error->code())},
              {"message", outcome.error->what()}});
  } else {
    settleStop();
  }
}

void JobRun::settleSuccess(const SolveOutcome& outcome) {
  for (const std::string& warning : outcome.warnings) {
    recorder_.recordWarning(warning);
  }
  saveProgress();
  const std::vector<ResultItem> items = makeItems(outcome.items);
  const bool is_stored = writeStubbornly(
      "results", [&] { return stores_.jobs.succeed(job_.ticket, items, outcome.verdict); });
  if (!is_stored) {
    settleStop();
    return;
  }
  metrics_.add("gaitmill_jobs_finished_total", {{"state", "succeeded"}});
  observeSuccess(recorder_.stages());
}

void JobRun::observeSuccess(const std::vector<api::StageTiming>& stages) {
  double seconds = 0;
  for (const api::StageTiming& stage : stages) {
    seconds += stage.seconds;
  }
  if (seconds > 0 && trial_seconds_ > 0) {
    metrics_.observe("gaitmill_realtime_factor", {}, trial_seconds_ / seconds);
  }
  logEvent(
      Severity::kInfo, "job.succeeded", {{"job_id", job_.ticket.job_id}, {"seconds", seconds}});
}

void JobRun::settleStop() {
  switch (stop_) {
    case Stop::kCancelled:
      if (stores_.jobs.cancelRunning(job_.ticket)) {
        metrics_.add("gaitmill_jobs_finished_total", {{"state", "cancelled"}});
        logEvent(Severity::kInfo, "job.cancelled", {{"job_id", job_.ticket.job_id}});
      }
      return;
    case Stop::kStopping:
      return giveBack("stopping");
    case Stop::kParkedTooLong:
      return giveBack("no_space");
    case Stop::kTicketLost:
    case Stop::kNone:
      logEvent(Severity::kWarn,
               "job.ticket_lost",
               {{"job_id", job_.ticket.job_id}, {"attempt", job_.ticket.claim}});
      return;
  }
}

void JobRun::settleDeath(const Error& reason) {
  DeathOutcome outcome = DeathOutcome::kTicketVoid;
  const bool is_written = writeStubbornly("death", [&] {
    outcome = stores_.jobs.recordDeath(job_.ticket, reason);
    return outcome != DeathOutcome::kTicketVoid;
  });
  if (!is_written) {
    settleStop();
    return;
  }
  metrics_.add("gaitmill_job_deaths_total", {{"code", std::string(codeName(reason.code()))}});
  if (outcome == DeathOutcome::kFailed || outcome == DeathOutcome::kCancelled) {
    const char* const state = outcome == DeathOutcome::kFailed ? "failed" : "cancelled";
    metrics_.add("gaitmill_jobs_finished_total", {{"state", state}});
  }
  logEvent(Severity::kWarn,
           "job.solver_died",
           {{"job_id", job_.ticket.job_id},
            {"code", codeName(reason.code())},
            {"message", reason.what()},
            {"outcome", outcome == DeathOutcome::kFailed ? "failed" : "taken up again"}});
}

// If even that cannot be stored, the lease lapses by time.
void JobRun::giveBack(const std::string& why) {
  const bool is_given = stores_.jobs.giveBack(job_.ticket);
  metrics_.add("gaitmill_jobs_given_back_total", {});
  logEvent(Severity::kInfo,
           is_given ? "job.given_back" : "job.ticket_lost",
           {{"job_id", job_.ticket.job_id}, {"message", why}});
}

}  // namespace gaitmill

#include "service/workers.h"

#include <spdlog/spdlog.h>

#include <exception>
#include <utility>

#include "api/dto/error_body.h"
#include "core/base/error.h"
#include "service/job_recorder.h"
#include "service/result_service.h"
#include "service/trial_service.h"

namespace gaitmill {

namespace {

constexpr std::chrono::milliseconds kStorageRetry{500};
constexpr int kStorageTries = 10;

// The database may be locked by a backup or out of space for a moment; what became of a job must
// not be lost for that.
template <class Write>
bool writeStubbornly(const std::string& job_id, Write write) {
  for (int attempt = 1;; ++attempt) {
    try {
      return write();
    } catch (const Error& error) {
      spdlog::error("job {}: {} (attempt {})", job_id, error.what(), attempt);
      if (attempt == kStorageTries) {
        return false;
      }
      std::this_thread::sleep_for(kStorageRetry);
    }
  }
}

}  // namespace

Workers::Workers(TrialStore& trials, JobStore& jobs, PipelineRunner run, int count)
    : trials_(trials), jobs_(jobs), run_(std::move(run)), count_(count) {}

Workers::~Workers() {
  stopping_ = true;
  wake();
  for (std::thread& thread : threads_) {
    if (thread.joinable()) {
      thread.join();
    }
  }
}

void Workers::start() {
  const std::lock_guard<std::mutex> lock(guard_);
  active_ = count_;
  for (int i = 0; i < count_; ++i) {
    threads_.emplace_back([this] { work(); });
  }
}

void Workers::wake() {
  const std::lock_guard<std::mutex> lock(guard_);
  ++submissions_;
  changed_.notify_all();
}

void Workers::cancel(const std::string& job_id) {
  const std::lock_guard<std::mutex> lock(guard_);
  const auto found = running_.find(job_id);
  if (found != running_.end()) {
    found->second->cancelled = true;
  }
}

bool Workers::stop(std::chrono::milliseconds limit) {
  std::unique_lock<std::mutex> lock(guard_);
  stopping_ = true;
  changed_.notify_all();
  if (changed_.wait_for(lock, limit, [this] { return active_ == 0; })) {
    return true;
  }
  for (const auto& [job_id, running] : running_) {
    spdlog::warn("job {}: its solver did not stop in time; back to the queue", job_id);
    jobs_.requeue(running->ticket);
  }
  return false;
}

void Workers::work() {
  std::unique_lock<std::mutex> lock(guard_);
  while (!stopping_) {
    const std::uint64_t seen = submissions_;
    lock.unlock();
    const bool found = claimAndRun();
    lock.lock();
    if (!found) {
      changed_.wait(lock, [&] { return stopping_ || submissions_ != seen; });
    }
  }
  --active_;
  changed_.notify_all();
}

bool Workers::claimAndRun() {
  try {
    const std::optional<ClaimedJob> job = jobs_.claimNext();
    if (job) {
      runJob(*job);
    }
    return job.has_value();
  } catch (const std::exception& error) {
    spdlog::error("worker: {}", error.what());
    std::this_thread::sleep_for(kStorageRetry);
    return true;
  }
}

void Workers::runJob(const ClaimedJob& job) {
  const std::string& id = job.ticket.job_id;
  const std::shared_ptr<RunningJob> running = enlist(job.ticket);
  spdlog::info("job {}: attempt {} begins", id, job.ticket.claim);
  try {
    const PipelineResult result = runPipelineOf(job, *running);
    const std::vector<ResultItem> items = makeResultItems(result);
    const bool stored = writeStubbornly(id, [&] { return jobs_.succeed(job.ticket, items); });
    spdlog::info("job {}: {}", id, stored ? "succeeded" : "its result could not be stored");
  } catch (const Error& error) {
    settle(*running, error);
  } catch (const std::exception& error) {
    settle(*running, Error(ErrorCode::kInternal, error.what()));
  }
  dismiss(job.ticket);
}

PipelineResult Workers::runPipelineOf(const ClaimedJob& job, const RunningJob& running) {
  JobRecorder recorder(jobs_, job.ticket);
  PipelineEvents events;
  events.progress = [&](Stage stage, double fraction) {
    return !running.cancelled && !stopping_ && recorder.recordProgress(stage, fraction);
  };
  events.warn = [&](const std::string& warning) {
    recorder.recordWarning(warning);
  };
  PipelineResult result =
      run_(readTrialInput(trials_, job.trial_id), {"settings", job.settings_json}, events);
  recorder.finish(result.warnings);
  return result;
}

// A stop that nobody asked for is a failure; one that the ticket's loss caused changes nothing.
void Workers::settle(const RunningJob& running, const Error& error) {
  const JobTicket& ticket = running.ticket;
  const bool stopped = error.code() == ErrorCode::kCancelled;
  if (stopped && running.cancelled) {
    writeStubbornly(ticket.job_id, [&] { return jobs_.cancelRunning(ticket); });
    spdlog::info("job {}: cancelled", ticket.job_id);
  } else if (stopped && stopping_) {
    writeStubbornly(ticket.job_id, [&] { return jobs_.requeue(ticket); });
    spdlog::info("job {}: back to the queue, the service stops", ticket.job_id);
  } else {
    const std::string body = api::renderErrorObject(error);
    writeStubbornly(ticket.job_id, [&] { return jobs_.fail(ticket, body); });
    spdlog::warn("job {}: failed: {}", ticket.job_id, error.what());
  }
}

std::shared_ptr<Workers::RunningJob> Workers::enlist(const JobTicket& ticket) {
  const std::lock_guard<std::mutex> lock(guard_);
  return running_[ticket.job_id] = std::make_shared<RunningJob>(ticket);
}

void Workers::dismiss(const JobTicket& ticket) {
  const std::lock_guard<std::mutex> lock(guard_);
  running_.erase(ticket.job_id);
}

}  // namespace gaitmill

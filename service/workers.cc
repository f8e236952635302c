#include "service/workers.h"

#include <exception>
#include <optional>
#include <utility>

#include "service/observe/log.h"

namespace gaitmill {

namespace {

constexpr std::chrono::milliseconds kStorageRetry{500};
constexpr std::chrono::seconds kLastWrites{5};  // for solvers to be gone and jobs to be given back

}  // namespace

Workers::Workers(Stores& stores,
                 const ShippedCatalog& shipped,
                 Metrics& metrics,
                 WorkersOptions options)
    : stores_(stores), shipped_(shipped), metrics_(metrics), options_(std::move(options)) {}

Workers::~Workers() {
  beginStop();
  killAll();
  for (std::thread& thread : threads_) {
    thread.join();
  }
}

void Workers::start() {
  const std::lock_guard<std::mutex> lock(guard_);
  active_ = options_.count;
  for (int i = 0; i < options_.count; ++i) {
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
    found->second->interrupt.raise();
  }
}

void Workers::beginStop() {
  const std::lock_guard<std::mutex> lock(guard_);
  stopping_ = true;
  changed_.notify_all();
}

bool Workers::stop(std::chrono::milliseconds limit) {
  beginStop();
  const auto have_ended = [this] {
    return active_ == 0;
  };
  {
    std::unique_lock<std::mutex> lock(guard_);
    if (changed_.wait_for(lock, limit, have_ended)) {
      return true;
    }
  }
  killAll();
  std::unique_lock<std::mutex> lock(guard_);
  return changed_.wait_for(lock, kLastWrites, have_ended);
}

void Workers::killAll() {
  const std::lock_guard<std::mutex> lock(guard_);
  killing_ = true;
  for (const auto& [job_id, signals] : running_) {
    signals->stopping = true;
    signals->interrupt.raise();
  }
}

void Workers::work() {
  std::unique_lock<std::mutex> lock(guard_);
  while (!stopping_) {
    const std::uint64_t seen = submissions_;
    lock.unlock();
    const bool found = claimAndRun();
    lock.lock();
    if (!found) {
      changed_.wait_for(
          lock, options_.look_around, [&] { return stopping_ || submissions_ != seen; });
    }
  }
  --active_;
  changed_.notify_all();
}

bool Workers::claimAndRun() {
  try {
    const std::optional<ClaimedJob> job =
        stores_.jobs.claimNext(options_.runs.owner, options_.runs.lease);
    if (job) {
      const std::shared_ptr<JobSignals> signals = enlist(job->ticket.job_id);
      JobRun(stores_, shipped_, options_.runs, metrics_, *job, *signals).run();
      dismiss(job->ticket.job_id, signals);
    }
    return job.has_value();
  } catch (const std::exception& error) {
    logEvent(Severity::kError, "worker.cannot_claim", {{"message", error.what()}});
    std::this_thread::sleep_for(kStorageRetry);
    return false;
  }
}

std::shared_ptr<JobSignals> Workers::enlist(const std::string& job_id) {
  const auto signals = std::make_shared<JobSignals>();
  const std::lock_guard<std::mutex> lock(guard_);
  signals->stopping = killing_;
  running_[job_id] = signals;
  return signals;
}

// A job whose lease has lapsed may be running here a second time.
void Workers::dismiss(const std::string& job_id, const std::shared_ptr<JobSignals>& signals) {
  const std::lock_guard<std::mutex> lock(guard_);
  const auto found = running_.find(job_id);
  if (found != running_.end() && found->second == signals) {
    running_.erase(found);
  }
}

}  // namespace gaitmill

#include "service/retention.h"

#include <string>

#include "core/base/error.h"
#include "service/observe/log.h"
#include "service/storage/clock.h"

namespace gaitmill {

namespace {

constexpr int kBatch = 100;                          // removed between two looks at what there is
constexpr std::int64_t kDay = 24LL * 3'600 * 1'000;  // [ms]

// Whether something could be removed; what cannot stays, and is in the log.
template <class Remove>
bool tryToRemove(const OwnedId& owned, const Remove& remove) {
  try {
    remove();
    return true;
  } catch (const Error& error) {
    logEvent(Severity::kWarn, "retention.stays", {{"id", owned.id}, {"message", error.what()}});
    return false;
  }
}

}  // namespace

Retention::Retention(Stores& stores, int keep_days) : stores_(stores), keep_days_(keep_days) {}

Retention::~Retention() {
  stop();
}

void Retention::start() {
  thread_ = std::thread([this] { run(); });
}

void Retention::stop() {
  {
    const std::lock_guard<std::mutex> lock(guard_);
    stopping_ = true;
  }
  stopped_.notify_all();
  if (thread_.joinable()) {
    thread_.join();
  }
}

Retention::Removed Retention::removeOld(std::int64_t now) {
  Removed removed;
  removed.answers = stores_.idempotency.removeExpired();
  if (keep_days_ == 0) {
    return removed;
  }
  const std::int64_t before = now - keep_days_ * kDay;
  while (removeJobs(before, removed) == kBatch) {
  }
  int trials = 0;
  do {
    trials = removeTrials(before);
    removed.trials += trials;
  } while (trials == kBatch);
  return removed;
}

// A full batch of removals may be followed by more; anything else was all that can go.
int Retention::removeJobs(std::int64_t before, Removed& removed) {
  int count = 0;
  for (const OwnedId& job : stores_.jobs.listFinished(before, kBatch)) {
    const bool gone = tryToRemove(job, [&] {
      const std::string study_id = stores_.jobs.find(job.tenant, job.id).study_id;
      stores_.jobs.remove(job.tenant, job.id);
      removeEmptyStudy(job.tenant, study_id, removed);
    });
    count += gone ? 1 : 0;
  }
  removed.jobs += count;
  return count;
}

int Retention::removeTrials(std::int64_t before) {
  int count = 0;
  for (const OwnedId& trial : stores_.trials.listUnused(before, kBatch)) {
    count += tryToRemove(trial, [&] { stores_.trials.remove(trial.tenant, trial.id); }) ? 1 : 0;
  }
  return count;
}

void Retention::removeEmptyStudy(const std::string& tenant,
                                 const std::string& study_id,
                                 Removed& removed) {
  if (!study_id.empty() && stores_.studies.find(tenant, study_id).job_ids.empty()) {
    stores_.studies.remove(tenant, study_id);
    ++removed.studies;
  }
}

void Retention::run() {
  std::unique_lock<std::mutex> lock(guard_);
  while (!stopping_) {
    lock.unlock();
    try {
      const Removed removed = removeOld(nowMilliseconds());
      logEvent(Severity::kInfo,
               "retention.removed",
               {{"jobs", removed.jobs},
                {"studies", removed.studies},
                {"trials", removed.trials},
                {"kept_answers", removed.answers}});
    } catch (const Error& error) {
      logEvent(Severity::kError, "retention.fails", {{"message", error.what()}});
    }
    lock.lock();
    stopped_.wait_for(lock, kInterval, [this] { return stopping_; });
  }
}

}  // namespace gaitmill

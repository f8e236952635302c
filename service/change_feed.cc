#include "service/change_feed.h"

#include <utility>
#include <vector>

#include "core/base/error.h"
#include "service/observe/log.h"

namespace gaitmill {

ChangeFeed::ChangeFeed(JobStore& jobs, JobListener listener, std::function<bool()> is_waited_for)
    : jobs_(jobs), listener_(std::move(listener)), is_waited_for_(std::move(is_waited_for)) {}

ChangeFeed::~ChangeFeed() {
  {
    const std::lock_guard<std::mutex> lock(guard_);
    stopping_ = true;
  }
  stopped_.notify_all();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void ChangeFeed::start() {
  seen_ = jobs_.lastChange();
  thread_ = std::thread([this] { run(); });
}

void ChangeFeed::run() {
  std::unique_lock<std::mutex> lock(guard_);
  while (!stopped_.wait_for(lock, kInterval, [this] { return stopping_; })) {
    lock.unlock();
    try {
      look();
    } catch (const Error& error) {
      logEvent(Severity::kWarn, "changes.unreadable", {{"message", error.what()}});
    }
    lock.lock();
  }
}

// Those who begin to wait read the state first, so that what happened before needs no telling.
void ChangeFeed::look() {
  if (!is_waited_for_()) {
    seen_ = jobs_.lastChange();
    return;
  }
  while (jobs_.lastChange() > seen_) {
    const std::vector<JobChange> changes = jobs_.listChanges(seen_);
    if (changes.empty()) {
      return;
    }
    for (const JobChange& change : changes) {
      listener_(change);
      seen_ = change.change;
    }
  }
}

}  // namespace gaitmill

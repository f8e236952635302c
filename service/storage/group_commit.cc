#include "service/storage/group_commit.h"

#include <algorithm>
#include <utility>

#include "core/base/error.h"
#include "service/storage/dialect.h"

namespace gaitmill {

namespace {

// Bounds how long one commit takes; more than the concurrent callers of a service.
constexpr std::size_t kMaxBatch = 256;
constexpr std::chrono::milliseconds kWipeAgainAfter{20};

enum class Emptying { kDone, kInUse, kFailed };

// Without waiting for readers: there are writers to serve.
Emptying emptyLog(Connection& db) {
  Emptying outcome = Emptying::kFailed;
  db.runScript(dialect::kWaitShort);
  try {
    Statement row = db.prepare(dialect::kEmptyLog);
    outcome = row.step() && row.integer(0) == 0 ? Emptying::kDone : Emptying::kInUse;
  } catch (const Error&) {
    outcome = Emptying::kFailed;  // asked again later, but nobody waits for a failing disk
  }
  db.runScript(dialect::kWaitLong);
  return outcome;
}

}  // namespace

GroupCommit::GroupCommit(std::unique_ptr<Connection> connection)
    : connection_(std::move(connection)), thread_([this] { loop(); }) {}

GroupCommit::~GroupCommit() {
  {
    const std::lock_guard<std::mutex> lock(guard_);
    stopping_ = true;
  }
  wanted_.notify_one();
  thread_.join();
}

void GroupCommit::run(const Work& work) {
  submit(small_, work);
}

void GroupCommit::runBulk(const Work& work) {
  submit(bulk_, work);
}

void GroupCommit::submit(std::deque<Request*>& queue, const Work& work) {
  Request request(work);
  std::unique_lock<std::mutex> lock(guard_);
  queue.push_back(&request);
  wanted_.notify_one();
  request.ended.wait(lock, [&request] { return request.done; });
  if (request.error) {
    std::rethrow_exception(request.error);
  }
}

bool GroupCommit::wipe(std::chrono::milliseconds limit) {
  std::unique_lock<std::mutex> lock(guard_);
  const std::uint64_t mine = ++wipes_wanted_;
  const std::uint64_t failures = wipe_failures_;
  wanted_.notify_one();
  wiped_changed_.wait_for(
      lock, limit, [&] { return wipes_done_ >= mine || wipe_failures_ > failures; });
  return wipes_done_ >= mine;
}

std::string GroupCommit::findFailure() const {
  const std::lock_guard<std::mutex> lock(guard_);
  return failure_;
}

void GroupCommit::loop() {
  std::unique_lock<std::mutex> lock(guard_);
  while (true) {
    waitForWork(lock);
    if (stopping_ && small_.empty() && bulk_.empty()) {
      return;
    }
    const Batch batch = take(small_, kMaxBatch);
    const Batch bulk = take(bulk_, 1);
    lock.unlock();
    process(batch);
    process(bulk);
    wipeIfWanted();
    lock.lock();
  }
}

void GroupCommit::waitForWork(std::unique_lock<std::mutex>& lock) {
  const auto has_work = [this] {
    return stopping_ || !small_.empty() || !bulk_.empty();
  };
  if (wipe_was_refused_) {
    wanted_.wait_for(lock, kWipeAgainAfter, has_work);
    return;
  }
  wanted_.wait(lock, [&] { return has_work() || wipes_done_ < wipes_wanted_; });
}

GroupCommit::Batch GroupCommit::take(std::deque<Request*>& queue, std::size_t limit) {
  const auto count = static_cast<std::ptrdiff_t>(std::min(queue.size(), limit));
  Batch batch(queue.begin(), queue.begin() + count);
  queue.erase(queue.begin(), queue.begin() + count);
  return batch;
}

void GroupCommit::process(const Batch& batch) {
  if (batch.empty()) {
    return;
  }
  failing_.clear();
  try {
    commit(batch);
  } catch (...) {
    noteFailure();
    rollBack();
    for (Request* request : batch) {
      if (!request->error) {
        request->error = std::current_exception();
      }
    }
  }
  const std::lock_guard<std::mutex> lock(guard_);
  failure_ = failing_;
  for (Request* request : batch) {
    request->done = true;
    request->ended.notify_one();
  }
}

void GroupCommit::commit(const Batch& batch) {
  connection_->prepare(dialect::kBeginWrite).run();
  for (Request* request : batch) {
    runOne(*request);
  }
  connection_->prepare(dialect::kCommit).run();
}

// A full disk may end the whole transaction; what the batch did before is then gone as well.
void GroupCommit::runOne(Request& request) {
  connection_->prepare(dialect::kSave).run();
  try {
    request.work(*connection_);
    connection_->prepare(dialect::kRelease).run();
  } catch (...) {
    if (!connection_->isInTransaction()) {
      throw;
    }
    request.error = std::current_exception();
    noteFailure();
    connection_->prepare(dialect::kRollBackToSave).run();
    connection_->prepare(dialect::kRelease).run();
  }
}

// Within a handler: a fault of the storage, not of what the closure was asked to do.
void GroupCommit::noteFailure() {
  try {
    throw;
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kStorage || error.code() == ErrorCode::kStorageFull) {
      failing_ = error.message();
    }
  } catch (...) {
    failing_.clear();
  }
}

void GroupCommit::rollBack() noexcept {
  try {
    if (connection_->isInTransaction()) {
      connection_->prepare(dialect::kRollBack).run();
    }
  } catch (const Error&) {
    // The transaction is gone either way: SQLite ends it before it reports.
  }
}

// Readers, of this process or another, keep the log in use as long as they read.
void GroupCommit::wipeIfWanted() {
  std::uint64_t wanted = 0;
  {
    const std::lock_guard<std::mutex> lock(guard_);
    if (wipes_done_ >= wipes_wanted_) {
      return;
    }
    wanted = wipes_wanted_;
  }
  const Emptying outcome = emptyLog(*connection_);
  const bool emptied = outcome == Emptying::kDone;
  const bool failed = outcome == Emptying::kFailed;
  const std::lock_guard<std::mutex> lock(guard_);
  wipe_was_refused_ = !emptied;
  wipes_done_ = emptied ? wanted : wipes_done_;
  wipe_failures_ += failed ? 1U : 0U;
  if (emptied || failed) {
    wiped_changed_.notify_all();
  }
}

}  // namespace gaitmill

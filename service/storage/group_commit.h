#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "service/storage/connection.h"

namespace gaitmill {

/// The one thread that writes. Closures that wait while a commit is being synced make up the next
/// batch: one transaction, a savepoint each, one fsync. Bulky closures get transactions of their
/// own, one between two batches, so that a large upload holds nobody up for longer than one piece.
class GroupCommit {
 public:
  using Work = std::function<void(Connection&)>;

  explicit GroupCommit(std::unique_ptr<Connection> connection);
  /// Finishes what is queued first.
  ~GroupCommit();
  GroupCommit(const GroupCommit&) = delete;
  GroupCommit& operator=(const GroupCommit&) = delete;

  /// Returns when the work is durable. @throws what the work or the commit throws
  void run(const Work& work);
  void runBulk(const Work& work);
  /// Empties the log after all that was written before the call. @returns false if the disk failed,
  /// or readers stood in the way until the limit; it is then tried again until it is done.
  bool wipe(std::chrono::milliseconds limit);
  /// Why the last batch failed; empty once another has succeeded.
  std::string findFailure() const;

 private:
  struct Request {
    explicit Request(const Work& closure) : work(closure) {}
    const Work& work;
    std::exception_ptr error;
    bool done = false;
    std::condition_variable ended;
  };
  using Batch = std::vector<Request*>;

  void submit(std::deque<Request*>& queue, const Work& work);
  void loop();
  void waitForWork(std::unique_lock<std::mutex>& lock);
  static Batch take(std::deque<Request*>& queue, std::size_t limit);
  void process(const Batch& batch);
  void commit(const Batch& batch);
  void runOne(Request& request);
  void noteFailure();
  void rollBack() noexcept;
  void wipeIfWanted();

  std::unique_ptr<Connection> connection_;
  mutable std::mutex guard_;
  std::condition_variable wanted_;
  std::condition_variable wiped_changed_;
  std::deque<Request*> small_;
  std::deque<Request*> bulk_;
  std::uint64_t wipes_wanted_ = 0;
  std::uint64_t wipes_done_ = 0;
  std::uint64_t wipe_failures_ = 0;
  bool wipe_was_refused_ = false;  ///< by a reader: try again in a moment
  bool stopping_ = false;
  std::string failing_;  ///< of the batch under way, for the writer thread alone
  std::string failure_;
  std::thread thread_;
};

}  // namespace gaitmill

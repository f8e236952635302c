#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace gaitmill::api {

/// Threads that answer requests, with a bounded queue before them.
class HandlerPool {
 public:
  enum class Lane {
    kContinue,  ///< the next step of an answer already begun: first, and never turned away
    kQuick,     ///< a request
    kHeavy,     ///< one with a large body: at most half of the threads, so that quick ones pass
  };
  using Task = std::function<void()>;

  HandlerPool(std::size_t threads, std::size_t max_queued);
  /// Drops what is queued and waits for what runs.
  ~HandlerPool();
  HandlerPool(const HandlerPool&) = delete;
  HandlerPool& operator=(const HandlerPool&) = delete;

  /// Runs the task on one of the threads. It must not throw.
  /// @returns false if the queue is full; never for kContinue
  bool submit(Lane lane, Task task);
  /// Requests waiting for a thread.
  std::size_t queued() const { return queued_; }

 private:
  void work();
  bool takeTask(Task& task, Lane& lane);

  const std::size_t max_queued_;
  const std::size_t max_heavy_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Task> continued_;
  std::deque<Task> quick_;
  std::deque<Task> heavy_;
  std::size_t running_heavy_ = 0;
  std::atomic<std::size_t> queued_{0};
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace gaitmill::api

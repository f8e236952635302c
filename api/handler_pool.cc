#include "api/handler_pool.h"

#include <algorithm>
#include <utility>

namespace gaitmill::api {

HandlerPool::HandlerPool(std::size_t threads, std::size_t max_queued)
    : max_queued_(max_queued), max_heavy_(std::max<std::size_t>(threads / 2, 1)) {
  for (std::size_t i = 0; i < std::max<std::size_t>(threads, 1); ++i) {
    threads_.emplace_back([this] { work(); });
  }
}

HandlerPool::~HandlerPool() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) {
    thread.join();
  }
}

bool HandlerPool::submit(Lane lane, Task task) {
  {
    const std::lock_guard lock(mutex_);
    if (lane == Lane::kContinue) {
      continued_.push_back(std::move(task));
    } else if (queued_ >= max_queued_) {
      return false;
    } else {
      (lane == Lane::kQuick ? quick_ : heavy_).push_back(std::move(task));
      ++queued_;
    }
  }
  wake_.notify_one();
  return true;
}

// Requires the lock. @returns false if nothing may run now
bool HandlerPool::takeTask(Task& task, Lane& lane) {
  const auto take = [&](std::deque<Task>& queue, Lane from) {
    task = std::move(queue.front());
    queue.pop_front();
    lane = from;
    queued_ -= from == Lane::kContinue ? 0U : 1U;
    return true;
  };
  if (!continued_.empty()) {
    return take(continued_, Lane::kContinue);
  }
  if (!quick_.empty()) {
    return take(quick_, Lane::kQuick);
  }
  if (!heavy_.empty() && running_heavy_ < max_heavy_) {
    ++running_heavy_;
    return take(heavy_, Lane::kHeavy);
  }
  return false;
}

void HandlerPool::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    Task task;
    Lane lane = Lane::kQuick;
    wake_.wait(lock, [&] { return stopping_ || takeTask(task, lane); });
    if (!task) {
      return;
    }
    lock.unlock();
    task();
    task = nullptr;  // what it holds ends without the lock
    lock.lock();
    if (lane == Lane::kHeavy) {
      --running_heavy_;
      wake_.notify_one();
    }
  }
}

}  // namespace gaitmill::api

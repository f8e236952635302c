#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>

#include "service/storage/job_store.h"

namespace gaitmill {

/// Tells of jobs that other processes have changed, by looking at the number of the last change.
/// Looks only while somebody waits for a change.
class ChangeFeed {
 public:
  static constexpr std::chrono::milliseconds kInterval{200};

  /// @param is_waited_for  whether anybody listens at the moment
  ChangeFeed(JobStore& jobs, JobListener listener, std::function<bool()> is_waited_for);
  ~ChangeFeed();
  ChangeFeed(const ChangeFeed&) = delete;
  ChangeFeed& operator=(const ChangeFeed&) = delete;

  void start();

 private:
  void run();
  void look();

  JobStore& jobs_;
  JobListener listener_;
  std::function<bool()> is_waited_for_;
  std::int64_t seen_ = 0;
  std::mutex guard_;
  std::condition_variable stopped_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace gaitmill

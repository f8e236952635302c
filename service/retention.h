#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

#include "service/stores.h"

namespace gaitmill {

/// Removes what is older than the days to keep: jobs that ended before that, studies that have lost
/// all their jobs, and trials that no job refers to. Also forgets idempotency keys after their day.
class Retention {
 public:
  static constexpr std::chrono::minutes kInterval{60};

  struct Removed {
    int jobs = 0;
    int studies = 0;
    int trials = 0;
    int answers = 0;  ///< of idempotency keys
  };

  /// @param keep_days  0 = for ever
  Retention(Stores& stores, int keep_days);
  ~Retention();
  Retention(const Retention&) = delete;
  Retention& operator=(const Retention&) = delete;

  /// A thread that removes now and then every hour.
  void start();
  void stop();

  /// Removes what is too old at this time [ms since 1970 UTC]. Something that cannot be removed (it
  /// is being used again) stays for the next time.
  Removed removeOld(std::int64_t now);

 private:
  void run();
  int removeJobs(std::int64_t before, Removed& removed);
  int removeTrials(std::int64_t before);
  void removeEmptyStudy(const std::string& tenant, const std::string& study_id, Removed& removed);

  Stores& stores_;
  int keep_days_;
  std::mutex guard_;
  std::condition_variable stopped_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace gaitmill

// Two databases on one file stand for two processes, as `gaitmill serve` and `gaitmill work`.

#include "service/change_feed.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/service/port_fixture.h"

namespace gaitmill {
namespace {

constexpr std::chrono::seconds kPatience{60};

class ChangeFeedTest : public ::testing::Test {
 protected:
  ChangeFeedTest()
      : other_(DatabaseOptions{fixture_.database().path(), DatabaseUse::kWork}),
        other_jobs_(other_),
        feed_(
            fixture_.stores().jobs,
            [this](const JobChange& change) {
              const std::lock_guard<std::mutex> lock(guard_);
              told_.push_back(change.job_id);
              changed_.notify_all();
            },
            [this] {
              ++looks_;
              changed_.notify_all();
              return is_waited_for_.load();
            }) {}

  bool isTold(const std::string& job_id) {
    std::unique_lock<std::mutex> lock(guard_);
    return changed_.wait_for(lock, kPatience, [&] {
      return std::find(told_.begin(), told_.end(), job_id) != told_.end();
    });
  }
  /// Waits until the feed has looked `count` more times to the end.
  void letItLook(int count) {
    const int until = looks_ + count + 1;
    std::unique_lock<std::mutex> lock(guard_);
    ASSERT_TRUE(changed_.wait_for(lock, kPatience, [&] { return looks_ >= until; }));
  }

  const api::Identity who_ = makeMember("lab");
  PortFixture fixture_;
  Database other_;
  JobStore other_jobs_;
  std::mutex guard_;
  std::condition_variable changed_;
  std::vector<std::string> told_;
  std::atomic<bool> is_waited_for_{true};
  std::atomic<int> looks_{0};
  ChangeFeed feed_;
};

TEST_F(ChangeFeedTest, TellsOfJobsThatAnotherProcessChanges) {
  fixture_.addJob(who_, fixture_.addTrial(who_));
  const std::string job = fixture_.addJob(who_, fixture_.addTrial(who_, "others"));
  feed_.start();
  other_jobs_.requestCancel(who_.tenant, job);
  EXPECT_TRUE(isTold(job));
  const std::lock_guard<std::mutex> lock(guard_);
  EXPECT_EQ(told_, std::vector<std::string>{job}) << "what stood before the start is no news";
}

TEST_F(ChangeFeedTest, WhatNobodyWaitedForIsNotToldLater) {
  const std::string first = fixture_.addJob(who_, fixture_.addTrial(who_));
  const std::string second = fixture_.addJob(who_, fixture_.addTrial(who_, "others"));
  is_waited_for_ = false;
  feed_.start();
  other_jobs_.requestCancel(who_.tenant, first);
  letItLook(2);
  is_waited_for_ = true;
  other_jobs_.requestCancel(who_.tenant, second);
  EXPECT_TRUE(isTold(second));
  const std::lock_guard<std::mutex> lock(guard_);
  EXPECT_EQ(told_, std::vector<std::string>{second});
}

}  // namespace
}  // namespace gaitmill

#include "service/storage/job_states.h"

#include <gtest/gtest.h>

namespace gaitmill {
namespace {

using State = api::JobState;
constexpr State kAll[] = {
    State::kQueued, State::kRunning, State::kSucceeded, State::kFailed, State::kCancelled};

TEST(JobStates, FinalStatesNeverChange) {
  for (const State from : kAll) {
    for (const State to : kAll) {
      EXPECT_FALSE(api::isFinal(from) && isAllowedChange(from, to))
          << api::jobStateName(from) << " -> " << api::jobStateName(to);
    }
  }
}

TEST(JobStates, WorkBeginsInTheQueueAndNeverReturnsToIt) {
  EXPECT_TRUE(isAllowedChange(State::kQueued, State::kRunning));
  EXPECT_FALSE(isAllowedChange(State::kRunning, State::kQueued));
  EXPECT_FALSE(isAllowedChange(State::kQueued, State::kSucceeded));
  EXPECT_FALSE(isAllowedChange(State::kQueued, State::kFailed));
}

}  // namespace
}  // namespace gaitmill

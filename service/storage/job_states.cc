#include "service/storage/job_states.h"

#include <algorithm>
#include <array>
#include <utility>

namespace gaitmill {

bool isAllowedChange(api::JobState from, api::JobState to) {
  using State = api::JobState;
  static constexpr std::array<std::pair<State, State>, 5> kAllowed{
      {{State::kQueued, State::kRunning},
       {State::kQueued, State::kCancelled},
       {State::kRunning, State::kSucceeded},
       {State::kRunning, State::kFailed},
       {State::kRunning, State::kCancelled}}};
  return std::find(kAllowed.begin(), kAllowed.end(), std::pair(from, to)) != kAllowed.end();
}

}  // namespace gaitmill

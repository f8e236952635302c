#include "api/mailbox.h"

namespace gaitmill::api {

namespace {
constexpr std::size_t kMostTopics = 4096;
}  // namespace

void Mailbox::put(Answer answer) {
  bool was_empty = false;
  {
    const std::lock_guard lock(mutex_);
    was_empty = answers_.empty() && notices_.empty();
    answers_.push_back(std::move(answer));
  }
  if (was_empty) {
    wake_();
  }
}

void Mailbox::put(const Topic& topic) {
  bool was_empty = false;
  {
    const std::lock_guard lock(mutex_);
    was_empty = answers_.empty() && notices_.empty();
    ++sequence_;
    // Of many notices of one topic between two looks, the last says all.
    if (!notices_.empty() && notices_.back().topic == topic) {
      notices_.back().sequence = sequence_;
    } else {
      notices_.push_back({topic, sequence_});
    }
  }
  if (was_empty) {
    wake_();
  }
}

std::uint64_t Mailbox::sequence() const {
  const std::lock_guard lock(mutex_);
  return sequence_;
}

void Mailbox::take(std::vector<Notice>& notices, std::vector<Answer>& answers) {
  notices.clear();
  answers.clear();
  const std::lock_guard lock(mutex_);
  notices.swap(notices_);
  answers.swap(answers_);
}

void NoticeLog::note(const Notice& notice) {
  if (last_.size() >= kMostTopics) {
    last_.clear();
    forgotten_until_ = notice.sequence;
  }
  last_[notice.topic] = notice.sequence;
}

bool NoticeLog::isChangedSince(const Topic& topic, std::uint64_t sequence) const {
  const auto found = last_.find(topic);
  return sequence < forgotten_until_ || (found != last_.end() && found->second > sequence);
}

}  // namespace gaitmill::api

#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/http.h"
#include "api/response.h"
#include "core/base/error.h"

namespace gaitmill::api {

/// What a handler thread did for a connection: a response, the next piece of one, or a piece of the
/// body stored.
struct Answer {
  std::uint64_t connection = 0;
  std::uint64_t step = 0;      ///< of the connection; an answer to an earlier step is dropped
  std::uint64_t asked_at = 0;  ///< Mailbox::sequence() before the handler looked
  bool failed = false;         ///< the piece could not be had, or not be stored
  std::optional<Error> fault;  ///< why it could not be stored
  Response response;
  std::string piece;  ///< next bytes of a source or an event stream
  bool events_ended = false;
};

struct Notice {
  Topic topic;
  std::uint64_t sequence = 0;  ///< of this notice, from 1
};

/// Brings answers and notices from any thread to the reactor and wakes it.
class Mailbox {
 public:
  /// @param wake  called when the box is no longer empty, from any thread
  explicit Mailbox(std::function<void()> wake) : wake_(std::move(wake)) {}

  void put(Answer answer);
  void put(const Topic& topic);
  /// Number of notices so far.
  std::uint64_t sequence() const;
  /// Takes everything, in order of arrival.
  void take(std::vector<Notice>& notices, std::vector<Answer>& answers);

 private:
  std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::uint64_t sequence_ = 0;
  std::vector<Notice> notices_;
  std::vector<Answer> answers_;
};

/// Tells whether a topic was noticed after a moment. Remembers a bounded number of topics; of the
/// forgotten ones it says yes, which costs a question and loses nothing.
class NoticeLog {
 public:
  void note(const Notice& notice);
  bool isChangedSince(const Topic& topic, std::uint64_t sequence) const;

 private:
  std::map<Topic, std::uint64_t> last_;
  std::uint64_t forgotten_until_ = 0;
};

}  // namespace gaitmill::api

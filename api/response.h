#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "api/http.h"
#include "api/request_head.h"

namespace gaitmill::api {

/// What of a request decides the form of its answer.
struct ReplyConditions {
  std::string request_id;
  bool is_head = false;
  bool is_read = false;  ///< GET or HEAD: Range and If-None-Match hold
  std::string accept_encoding;
  std::string if_none_match;
  std::string if_range;
  std::string range;
};

ReplyConditions findReplyConditions(const RequestHead& head, const std::string& request_id);

/// An answer ready to be sent: head, then body, then `remaining` bytes of `source`.
struct Response {
  int status = 200;
  std::string head;  ///< status line and headers without Date, Connection and the empty line
  std::string body;
  std::shared_ptr<const ByteSource> source;  ///< nullptr if body is all
  std::uint64_t offset = 0;                  ///< of what remains in source
  std::uint64_t remaining = 0;
  std::optional<EventFeed> events;  ///< body holds the first ones
  bool events_ended = false;
  std::optional<Park> park;  ///< then nothing else counts
};

/// Bytes of a source that are read and sent at once.
inline constexpr std::size_t kPieceBytes = 256U << 10U;

/// Turns a route's reply into what is sent: 304 where If-None-Match has its ETag, 206 or 416 for
/// one range of a reply that has an ETag or a source (several ranges get the whole), gzip where the
/// client takes it, the type is text and it gets smaller. The gzip variant has an ETag of its own,
/// "…-gzip". Reads the first piece of a source, and compresses: not for the reactor's thread.
/// @throws what the source or the event feed throws
Response prepareResponse(HttpReply reply, const ReplyConditions& conditions);

/// "Sun, 06 Nov 1994 08:49:37 GMT"
std::string formatHttpDate(std::int64_t unix_seconds);

}  // namespace gaitmill::api

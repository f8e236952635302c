#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/identity.h"

namespace gaitmill::api {

/// Bytes that need not be in memory: an upload in a spool file, a stored file read piece by piece.
/// Reads are safe from any one thread at a time.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  virtual std::uint64_t size() const = 0;
  /// Bytes [offset, offset + size), fewer at the end. @throws Error kStorage
  virtual std::string read(std::uint64_t offset, std::size_t size) const = 0;
};

/// A byte string as a source.
std::shared_ptr<const ByteSource> makeByteSource(std::string bytes);
/// Bytes [offset, offset + size) of another source, which lives as long as the slice.
std::shared_ptr<const ByteSource> makeSlice(std::shared_ptr<const ByteSource> whole,
                                            std::uint64_t offset,
                                            std::uint64_t size);
/// All of it in one string. @throws Error kRequestTooLarge if it has more than `limit` bytes
std::string readAll(const ByteSource& source, std::uint64_t limit);

/// One part of a multipart body. `file_name` is what the client called its file, only a label:
/// never a path on our side.
struct BodyPart {
  std::string name;
  std::string file_name;
  std::shared_ptr<const ByteSource> bytes;
};

/// A request as the routes see it, free of the transport. The path is decoded.
struct HttpRequest {
  std::string id;      ///< "req_…", also in the answer's Request-Id header and in the log
  std::string method;  ///< "GET", "POST", "PUT", "DELETE"; HEAD arrives as "GET"
  std::string path;
  std::map<std::string, std::string> captures;  ///< {"id", "job_…"} for the pattern /v1/jobs/{id}
  std::map<std::string, std::string> query;     ///< first value of each parameter
  std::map<std::string, std::string> headers;   ///< names in lower case
  Identity identity;                            ///< who asks; a local caller where no keys exist
  std::shared_ptr<const ByteSource> body;       ///< JSON or raw bytes; never null
  std::vector<BodyPart> parts;                  ///< of a multipart request
  bool wait_is_over = false;  ///< a parked request that has waited as long as it asked for

  /// Value of a header, empty if absent.
  const std::string& header(const std::string& lower_case_name) const;
};

/// Wakes long polls and event streams: "job_…" or "stu_…", the id of what changed.
using Topic = std::string;

/// A request that is to be asked again when `topic` changes, or once with `wait_is_over`. The
/// handler then gets the same request object, with whatever it changed in it.
struct Park {
  Topic topic;
  std::chrono::milliseconds limit{0};
};

/// Server-sent events. `next` returns what there is to send after the last call (complete "id: …\n
/// event: …\ndata: …\n\n" blocks, maybe empty) and is asked whenever the topic changes; it sets
/// `ended` when nothing more can come.
struct EventFeed {
  Topic topic;
  std::function<std::string(bool& ended)> next;
};

/// What a route answers. Exactly one of body, source, events and park carries the content.
struct HttpReply {
  int status = 200;
  std::string content_type = "application/json";
  std::map<std::string, std::string> headers;  ///< ETag included; the transport compares it with
                                               ///< If-None-Match and If-Range
  std::string body;
  std::shared_ptr<const ByteSource> source;  ///< sent piece by piece; Range is answered from it
  std::optional<EventFeed> events;
  std::optional<Park> park;
};

}  // namespace gaitmill::api

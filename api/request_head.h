#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace gaitmill::api {

struct HeadLimits {
  std::size_t target_bytes = 2048;        ///< [bytes] of path and query
  std::size_t header_bytes = 16U << 10U;  ///< [bytes] of request line and headers
  std::size_t headers = 64;
};

/// Request line and headers, taken apart by RFC 9112 without its leniencies: whatever two parsers
/// could read differently is refused, because that is how requests are smuggled past a proxy.
struct RequestHead {
  std::string method;
  std::string path;                          ///< decoded
  std::map<std::string, std::string> query;  ///< decoded, first value of each parameter
  std::map<std::string, std::string>
      headers;  ///< names in lower case, repeated ones joined by ", "
  std::optional<std::uint64_t> content_length;
  bool keep_alive = true;  ///< by version and Connection header

  bool has(const std::string& lower_case_name) const { return headers.count(lower_case_name) > 0; }
  const std::string& header(const std::string& lower_case_name) const;
};

/// Where the head ends: behind its empty line, or behind the first line end that is not CRLF, which
/// parseRequestHead() refuses. npos while neither is there. Bytes before `from` are known to hold
/// no end.
std::size_t findHeadEnd(std::string_view bytes, std::size_t from = 0);

/// Refuses the beginning of a head that can no longer become a good one, so that nobody waits for
/// its end. @throws Error kRequestMalformed, kRequestUriTooLong, kRequestHeadersTooLarge
void checkPartialHead(std::string_view bytes, const HeadLimits& limits);

/// @param head  up to its end as findHeadEnd() gives it. Any bytes are safe.
/// @throws Error kRequestMalformed, kRequestUriTooLong, kRequestHeadersTooLarge
RequestHead parseRequestHead(std::string_view head, const HeadLimits& limits);

/// "Text/HTML; charset=utf-8" -> "text/html"
std::string findMediaType(const std::string& content_type);

std::string toLower(std::string text);

}  // namespace gaitmill::api

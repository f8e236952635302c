#include "api/response.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <ctime>
#include <map>
#include <string_view>
#include <utility>

#include <httplib.h>

#include "api/errors.h"
#include "core/base/error.h"

namespace gaitmill::api {

namespace {

constexpr std::uint64_t kLeastGzip = 1024;           // [bytes]; below, a packet is a packet
constexpr std::uint64_t kMostGzip = 32ULL << 20U;    // [bytes]; above, it would take seconds
constexpr std::string_view kGzipSuffix = "-gzip\"";  // in place of an ETag's closing quote

std::string_view trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) {
    return {};
  }
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

// Takes the text up to the next `separator` off the front of `rest`.
std::string_view takeUntil(std::string_view& rest, char separator) {
  const std::size_t end = std::min(rest.find(separator), rest.size());
  const std::string_view item = trim(rest.substr(0, end));
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return item;
}

std::string_view reasonOf(int status) {
  static const std::map<int, std::string_view> kReasons = {
      {200, "OK"},
      {201, "Created"},
      {202, "Accepted"},
      {204, "No Content"},
      {206, "Partial Content"},
      {304, "Not Modified"},
      {400, "Bad Request"},
      {401, "Unauthorized"},
      {403, "Forbidden"},
      {404, "Not Found"},
      {405, "Method Not Allowed"},
      {406, "Not Acceptable"},
      {408, "Request Timeout"},
      {409, "Conflict"},
      {411, "Length Required"},
      {412, "Precondition Failed"},
      {413, "Content Too Large"},
      {414, "URI Too Long"},
      {415, "Unsupported Media Type"},
      {416, "Range Not Satisfiable"},
      {422, "Unprocessable Content"},
      {429, "Too Many Requests"},
      {431, "Request Header Fields Too Large"},
      {500, "Internal Server Error"},
      {503, "Service Unavailable"},
      {507, "Insufficient Storage"},
  };
  const auto found = kReasons.find(status);
  return found == kReasons.end() ? "Unassigned" : found->second;
}

// --- entity tags ---

std::string makeGzipTag(const std::string& tag) {
  return tag.empty() || tag.back() != '"' ? tag : tag.substr(0, tag.size() - 1).append(kGzipSuffix);
}

std::string_view dropWeakness(std::string_view tag) {
  return tag.substr(0, 2) == "W/" ? tag.substr(2) : tag;
}

// Weak comparison (RFC 9110, 8.8.3.2) with each tag of a list.
bool matchesAny(std::string_view list, const std::string& tag) {
  if (trim(list) == "*") {
    return true;
  }
  while (!list.empty()) {
    if (dropWeakness(takeUntil(list, ',')) == dropWeakness(tag)) {
      return true;
    }
  }
  return false;
}

// The tag that the client has already, empty if it has none. Both variants are of the same content.
std::string findMatchingTag(const std::string& if_none_match, const std::string& tag) {
  for (const std::string& variant : {tag, makeGzipTag(tag)}) {
    if (matchesAny(if_none_match, variant)) {
      return variant;
    }
  }
  return "";
}

// --- ranges ---

struct ByteRange {
  std::uint64_t first = 0;
  std::uint64_t size = 0;
};

std::optional<std::uint64_t> parseNumber(std::string_view text) {
  const bool is_number =
      !text.empty() && text.size() <= 18 &&
      std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  return is_number ? std::optional<std::uint64_t>(std::stoull(std::string(text))) : std::nullopt;
}

// Of one range. nullopt = to be ignored: another unit, several ranges, or not a range.
// @throws Error kRequestRange if it is a range and nothing of it is there
std::optional<ByteRange> parseRange(std::string_view header, std::uint64_t size) {
  const std::string_view text = trim(header);
  const std::size_t dash = text.find('-');
  if (toLower(std::string(text.substr(0, 6))) != "bytes=" || dash == std::string_view::npos ||
      text.find(',') != std::string_view::npos) {
    return std::nullopt;
  }
  const std::optional<std::uint64_t> first = parseNumber(trim(text.substr(6, dash - 6)));
  const std::string_view behind = trim(text.substr(dash + 1));
  const std::optional<std::uint64_t> last = parseNumber(behind);
  const bool is_suffix = trim(text.substr(6, dash - 6)).empty();
  if ((is_suffix && !last) || (!is_suffix && !first) || (!behind.empty() && !last) ||
      (first && last && *last < *first)) {
    return std::nullopt;
  }
  const bool has_any = is_suffix ? *last > 0 && size > 0 : *first < size;
  require(has_any,
          ErrorCode::kRequestRange,
          "there are " + std::to_string(size) + " bytes, none of them in this range",
          {"", 0, 0, "Range"});
  if (is_suffix) {
    const std::uint64_t count = std::min(*last, size);
    return ByteRange{size - count, count};
  }
  const std::uint64_t end = last ? std::min(*last, size - 1) : size - 1;
  return ByteRange{*first, end - *first + 1};
}

// --- gzip ---

bool isCompressible(const std::string& content_type) {
  const std::string type = findMediaType(content_type);
  const auto endsWith = [&type](std::string_view end) {
    return type.size() >= end.size() &&
           type.compare(type.size() - end.size(), end.size(), end) == 0;
  };
  return type.compare(0, 5, "text/") == 0 || type == "application/json" ||
         type == "application/xml" || type == "application/yaml" || endsWith("+json") ||
         endsWith("+xml");
}

// Whether "gzip" (or "*") has a weight above 0 in Accept-Encoding.
bool takesGzip(std::string_view accept_encoding) {
  bool takes = false;
  while (!accept_encoding.empty()) {
    std::string_view item = takeUntil(accept_encoding, ',');
    const std::string coding = toLower(std::string(takeUntil(item, ';')));
    const std::string weight = toLower(std::string(trim(item)));
    const bool is_refused = weight.compare(0, 3, "q=0") == 0 &&
                            weight.find_first_of("123456789", 3) == std::string::npos;
    if (coding == "gzip" || coding == "x-gzip") {
      return !is_refused;
    }
    takes = takes || (coding == "*" && !is_refused);
  }
  return takes;
}

std::string compress(const std::string& bytes) {
  httplib::detail::gzip_compressor compressor;
  std::string packed;
  compressor.compress(bytes.data(), bytes.size(), true, [&packed](const char* data, std::size_t n) {
    packed.append(data, n);
    return true;
  });
  return packed;
}

// --- putting it together ---

std::uint64_t sizeOf(const HttpReply& reply) {
  return reply.source ? reply.source->size() : reply.body.size();
}

std::string findHeader(const HttpReply& reply, const std::string& name) {
  const auto found = reply.headers.find(name);
  return found == reply.headers.end() ? "" : found->second;
}

void addVary(HttpReply& reply) {
  std::string& vary = reply.headers["Vary"];
  vary += vary.empty() ? "Accept-Encoding" : ", Accept-Encoding";
}

void compressIfSmaller(HttpReply& reply) {
  const std::uint64_t size = sizeOf(reply);
  std::string packed = compress(reply.source ? readAll(*reply.source, size) : reply.body);
  if (packed.empty() || packed.size() >= size) {
    return;
  }
  reply.source = nullptr;
  reply.body = std::move(packed);
  reply.headers["Content-Encoding"] = "gzip";
  if (reply.headers.count("ETag") > 0) {
    reply.headers["ETag"] = makeGzipTag(reply.headers["ETag"]);
  }
}

bool isNotModified(HttpReply& reply, const ReplyConditions& conditions) {
  const std::string tag = findHeader(reply, "ETag");
  if (conditions.if_none_match.empty() || tag.empty()) {
    return false;
  }
  const std::string known = findMatchingTag(conditions.if_none_match, tag);
  if (known.empty()) {
    return false;
  }
  reply.headers["ETag"] = known;
  reply.status = 304;
  reply.body.clear();
  reply.source = nullptr;
  return true;
}

// The range to be sent. If-Range must be our strong tag: a part of another version is of no use.
std::optional<ByteRange> findRange(const HttpReply& reply, const ReplyConditions& conditions) {
  const std::string tag = findHeader(reply, "ETag");
  const bool has_ranges = reply.source != nullptr || !tag.empty();
  const bool is_current =
      conditions.if_range.empty() || (conditions.if_range == tag && tag.compare(0, 2, "W/") != 0);
  return has_ranges && is_current && !conditions.range.empty()
             ? parseRange(conditions.range, sizeOf(reply))
             : std::nullopt;
}

// Line ends in a value would end the header and begin another one.
std::string makeHeader(const std::string& name, std::string value) {
  std::replace_if(
      value.begin(),
      value.end(),
      [](unsigned char letter) { return letter < 0x20 || letter == 0x7f; },
      ' ');
  return name + ": " + value + "\r\n";
}

std::string makeHead(const HttpReply& reply, const ReplyConditions& conditions) {
  std::string head = "HTTP/1.1 " + std::to_string(reply.status) + " " +
                     std::string(reasonOf(reply.status)) + "\r\n";
  for (const auto& [name, value] : reply.headers) {
    head += makeHeader(name, value);
  }
  if (reply.status != 204 && reply.status != 304) {
    head += makeHeader("Content-Type", reply.content_type);
  }
  if (reply.headers.count("Cache-Control") == 0) {
    // With a tag, asking whether it still holds is all that a cache may do.
    head += reply.headers.count("ETag") > 0 ? "Cache-Control: private, no-cache\r\n"
                                            : "Cache-Control: no-store\r\n";
  }
  head += "X-Content-Type-Options: nosniff\r\n";
  return head + makeHeader("Request-Id", conditions.request_id);
}

Response prepareEvents(HttpReply reply, const ReplyConditions& conditions) {
  Response response;
  reply.content_type = "text/event-stream";
  reply.headers["Cache-Control"] = "no-store";
  reply.headers["X-Accel-Buffering"] = "no";  // nginx would hold events back
  response.status = reply.status;
  response.head = makeHead(reply, conditions);
  response.events_ended = conditions.is_head;
  if (!conditions.is_head) {
    response.body = reply.events->next(response.events_ended);
  }
  response.events = std::move(reply.events);
  return response;
}

void setRange(HttpReply& reply, const ByteRange& range) {
  reply.status = 206;
  reply.headers["Content-Range"] = "bytes " + std::to_string(range.first) + "-" +
                                   std::to_string(range.first + range.size - 1) + "/" +
                                   std::to_string(sizeOf(reply));
}

// Content: `range` of the reply, or all of it.
void setContent(HttpReply reply,
                const std::optional<ByteRange>& range,
                const ReplyConditions& conditions,
                Response& response) {
  const ByteRange part = range.value_or(ByteRange{0, sizeOf(reply)});
  if (reply.status != 204 && reply.status != 304) {
    response.head += "Content-Length: " + std::to_string(part.size) + "\r\n";
  }
  if (conditions.is_head) {
    return;
  }
  if (!reply.source) {
    response.body = range ? reply.body.substr(static_cast<std::size_t>(part.first),
                                              static_cast<std::size_t>(part.size))
                          : std::move(reply.body);
    return;
  }
  const std::size_t piece =
      static_cast<std::size_t>(std::min<std::uint64_t>(part.size, kPieceBytes));
  response.body = reply.source->read(part.first, piece);
  check(response.body.size() == piece, "a byte source ends before its size");
  response.offset = part.first + piece;
  response.remaining = part.size - piece;
  response.source = response.remaining > 0 ? std::move(reply.source) : nullptr;
}

HttpReply replyRangeError(const Error& error, std::uint64_t size, const std::string& request_id) {
  HttpReply reply = replyError(error, request_id);
  reply.headers["Content-Range"] = "bytes */" + std::to_string(size);
  return reply;
}

// The forms of a 200 to GET or HEAD. @returns the range to be sent, if only one is
std::optional<ByteRange> negotiate(HttpReply& reply, const ReplyConditions& conditions) {
  const bool may_compress = isCompressible(reply.content_type) &&
                            reply.headers.count("Content-Encoding") == 0 &&
                            sizeOf(reply) >= kLeastGzip && sizeOf(reply) <= kMostGzip;
  if (may_compress) {
    addVary(reply);
  }
  if (isNotModified(reply, conditions)) {
    return std::nullopt;
  }
  if (reply.source) {
    reply.headers["Accept-Ranges"] = "bytes";
  }
  std::optional<ByteRange> range;
  try {
    range = findRange(reply, conditions);
  } catch (const Error& error) {
    reply = replyRangeError(error, sizeOf(reply), conditions.request_id);
    return std::nullopt;
  }
  if (range) {
    setRange(reply, *range);
  } else if (may_compress && !conditions.is_head && takesGzip(conditions.accept_encoding)) {
    compressIfSmaller(reply);
  }
  return range;
}

Response prepareContent(HttpReply reply, const ReplyConditions& conditions) {
  std::optional<ByteRange> range;
  if (conditions.is_read && reply.status == 200) {
    range = negotiate(reply, conditions);
  }
  Response response;
  response.status = reply.status;
  response.head = makeHead(reply, conditions);
  setContent(std::move(reply), range, conditions, response);
  return response;
}

}  // namespace

ReplyConditions findReplyConditions(const RequestHead& head, const std::string& request_id) {
  ReplyConditions conditions;
  conditions.request_id = request_id;
  conditions.is_head = head.method == "HEAD";
  conditions.is_read = conditions.is_head || head.method == "GET";
  conditions.accept_encoding = head.header("accept-encoding");
  conditions.if_none_match = head.header("if-none-match");
  conditions.if_range = head.header("if-range");
  conditions.range = head.header("range");
  return conditions;
}

Response prepareResponse(HttpReply reply, const ReplyConditions& conditions) {
  if (reply.park) {
    Response parked;
    parked.park.emplace(std::move(*reply.park));
    return parked;
  }
  if (reply.events) {
    return prepareEvents(std::move(reply), conditions);
  }
  return prepareContent(std::move(reply), conditions);
}

std::string formatHttpDate(std::int64_t unix_seconds) {
  const auto time = static_cast<std::time_t>(unix_seconds);
  std::tm utc{};
  ::gmtime_r(&time, &utc);
  std::array<char, 64> text{};
  const std::size_t size =
      std::strftime(text.data(), text.size(), "%a, %d %b %Y %H:%M:%S GMT", &utc);
  return {text.data(), size};
}

}  // namespace gaitmill::api

#include "api/request_head.h"

#include <algorithm>
#include <array>
#include <utility>

#include <httplib.h>

#include "core/base/error.h"

namespace gaitmill::api {

namespace {

constexpr std::size_t kMaxMethod =
    16;  // [bytes]; the longest registered one has 17 and is not ours

bool isTokenLetter(char letter) {
  const auto code = static_cast<unsigned char>(letter);
  return std::isalnum(code) != 0 ||
         std::string_view("!#$%&'*+-.^_`|~").find(letter) != std::string_view::npos;
}

bool isToken(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), isTokenLetter);
}

// Visible ASCII, spaces, tabs, and the bytes above ASCII that HTTP calls obs-text.
bool isFieldText(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char letter) {
    const auto code = static_cast<unsigned char>(letter);
    return letter == '\t' || (code >= 0x20 && code != 0x7f);
  });
}

bool isVisible(std::string_view text) {
  return std::all_of(
      text.begin(), text.end(), [](char letter) { return letter > 0x20 && letter < 0x7f; });
}

void refuseUnless(bool ok, const std::string& message, const std::string& field) {
  require(ok, ErrorCode::kRequestMalformed, message, {"", 0, 0, field});
}

void requireShortTarget(std::size_t size, const HeadLimits& limits) {
  require(size <= limits.target_bytes,
          ErrorCode::kRequestUriTooLong,
          "path and query may have " + std::to_string(limits.target_bytes) + " bytes",
          {"", 0, 0, "path"});
}

void requireSmallHead(bool small, const std::string& found) {
  require(small, ErrorCode::kRequestHeadersTooLarge, found, {"", 0, 0, "headers"});
}

// Takes the line up to the next CRLF off the front of `rest`.
std::string_view takeLine(std::string_view& rest) {
  const std::size_t end = rest.find("\r\n");
  refuseUnless(
      end != std::string_view::npos, "every line of the head must end with CRLF", "headers");
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end + 2);
  return line;
}

std::string_view trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) {
    return {};
  }
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

// Two of these would let two readers disagree on where the request ends or whose it is.
bool isSingular(const std::string& name) {
  static constexpr std::array<std::string_view, 7> kSingular = {"authorization",
                                                                "content-encoding",
                                                                "content-length",
                                                                "content-type",
                                                                "host",
                                                                "range",
                                                                "transfer-encoding"};
  return std::find(kSingular.begin(), kSingular.end(), name) != kSingular.end();
}

void readHeader(std::string_view line, RequestHead& head) {
  const std::size_t colon = line.find(':');
  refuseUnless(colon != std::string_view::npos && isToken(line.substr(0, colon)),
               "a header must be a name, a colon without space before it, and a value on one line",
               "headers");
  const std::string name = toLower(std::string(line.substr(0, colon)));
  const std::string_view value = trim(line.substr(colon + 1));
  refuseUnless(isFieldText(value), "a header's value has control characters", name);
  const auto [entry, is_new] = head.headers.emplace(name, value);
  if (!is_new) {
    refuseUnless(!isSingular(name), "this header may be there once", name);
    entry->second.append(", ").append(value);
  }
}

// "http://host/path" is how requests to a proxy look; RFC 9112 wants servers to take it.
std::string_view dropAuthority(std::string_view target) {
  if (target.substr(0, 7) != "http://") {
    return target;
  }
  const std::size_t slash = target.find('/', 7);
  return slash == std::string_view::npos ? "/" : target.substr(slash);
}

// An encoded slash or NUL would be one segment to a proxy and something else to us: such a path
// names nothing here, and stays encoded so that no route matches it.
std::string decodePath(const std::string& raw) {
  const std::string lower = toLower(raw);
  const bool is_ambiguous = lower.find("%2f") != std::string::npos ||
                            lower.find("%5c") != std::string::npos ||
                            lower.find("%00") != std::string::npos;
  return is_ambiguous ? raw : httplib::detail::decode_url(raw, false);
}

void readTarget(std::string_view target, RequestHead& head) {
  refuseUnless(!target.empty() && isVisible(target) && target.find('#') == std::string_view::npos,
               "the request target has characters that must be percent-encoded",
               "path");
  const std::string_view local = dropAuthority(target);
  refuseUnless(local.front() == '/' || (local == "*" && head.method == "OPTIONS"),
               "the request target must be a path",
               "path");
  const std::size_t question = std::min(local.find('?'), local.size());
  head.path = decodePath(std::string(local.substr(0, question)));
  httplib::Params parameters;
  httplib::detail::parse_query_text(std::string(local.substr(std::min(question + 1, local.size()))),
                                    parameters);
  for (const auto& [name, value] : parameters) {
    head.query.emplace(name, value);
  }
}

void readRequestLine(std::string_view line, const HeadLimits& limits, RequestHead& head) {
  const std::size_t first = line.find(' ');
  const std::size_t last = line.rfind(' ');
  refuseUnless(first != std::string_view::npos && last > first,
               "the first line must be method, target and HTTP/1.1",
               "method");
  head.method = line.substr(0, first);
  refuseUnless(
      head.method.size() <= kMaxMethod && isToken(head.method), "the method is not one", "method");
  const std::string_view version = line.substr(last + 1);
  refuseUnless(version == "HTTP/1.1" || version == "HTTP/1.0",
               "the version must be HTTP/1.1 or HTTP/1.0",
               "version");
  head.keep_alive = version == "HTTP/1.1";
  const std::string_view target = line.substr(first + 1, last - first - 1);
  requireShortTarget(target.size(), limits);
  readTarget(target, head);
}

bool hasListItem(const std::string& list, std::string_view item) {
  std::string_view rest = list;
  while (!rest.empty()) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    if (toLower(std::string(trim(rest.substr(0, comma)))) == item) {
      return true;
    }
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return false;
}

// Digits only: a sign, a list or another base is read differently by different servers.
void readContentLength(RequestHead& head) {
  if (!head.has("content-length")) {
    return;
  }
  const std::string& text = head.header("content-length");
  refuseUnless(!text.empty() && text.size() <= 18 &&
                   std::all_of(text.begin(),
                               text.end(),
                               [](unsigned char letter) { return std::isdigit(letter) != 0; }),
               "Content-Length must be one number",
               "Content-Length");
  refuseUnless(!head.has("transfer-encoding"),
               "Content-Length and Transfer-Encoding exclude each other",
               "Transfer-Encoding");
  head.content_length = std::stoull(text);
}

void readConnection(RequestHead& head, bool is_newer) {
  const std::string& connection = head.header("connection");
  head.keep_alive =
      is_newer ? !hasListItem(connection, "close") : hasListItem(connection, "keep-alive");
}

}  // namespace

std::string toLower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char letter) {
    return static_cast<char>(letter >= 'A' && letter <= 'Z' ? letter + ('a' - 'A') : letter);
  });
  return text;
}

std::string findMediaType(const std::string& content_type) {
  return toLower(
      std::string(trim(std::string_view(content_type).substr(0, content_type.find(';')))));
}

const std::string& RequestHead::header(const std::string& lower_case_name) const {
  static const std::string kAbsent;
  const auto found = headers.find(lower_case_name);
  return found == headers.end() ? kAbsent : found->second;
}

std::size_t findHeadEnd(std::string_view bytes, std::size_t from) {
  // The last three bytes before `from` may be the beginning of the empty line.
  for (std::size_t at = from > 3 ? from - 3 : 0;;) {
    const std::size_t end = bytes.find('\n', at);
    if (end == std::string_view::npos) {
      return end;
    }
    const bool is_bare = end == 0 || bytes[end - 1] != '\r';
    if (is_bare || (end >= 3 && bytes.substr(end - 3, 4) == "\r\n\r\n")) {
      return end + 1;
    }
    at = end + 1;
  }
}

void checkPartialHead(std::string_view bytes, const HeadLimits& limits) {
  refuseUnless(bytes.empty() || isTokenLetter(bytes.front()), "this is not HTTP", "method");
  const bool has_line = bytes.find('\n') != std::string_view::npos;
  const std::size_t frame = kMaxMethod + std::string_view("  HTTP/1.1\r").size();
  if (!has_line && bytes.size() > frame) {
    requireShortTarget(bytes.size() - frame, limits);
  }
  requireSmallHead(bytes.size() <= limits.header_bytes,
                   "the headers may have " + std::to_string(limits.header_bytes) + " bytes");
}

RequestHead parseRequestHead(std::string_view head_bytes, const HeadLimits& limits) {
  checkPartialHead(head_bytes, limits);
  RequestHead head;
  std::string_view rest = head_bytes;
  readRequestLine(takeLine(rest), limits, head);
  std::size_t count = 0;
  for (std::string_view line = takeLine(rest); !line.empty(); line = takeLine(rest)) {
    requireSmallHead(++count <= limits.headers,
                     "there may be " + std::to_string(limits.headers) + " headers");
    readHeader(line, head);
  }
  const bool is_newer = head.keep_alive;
  refuseUnless(!is_newer || head.has("host"), "HTTP/1.1 requires the Host header", "Host");
  refuseUnless(is_newer || !head.has("transfer-encoding"),
               "HTTP/1.0 has no Transfer-Encoding",
               "Transfer-Encoding");
  readContentLength(head);
  readConnection(head, is_newer);
  return head;
}

}  // namespace gaitmill::api

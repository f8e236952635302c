#include "api/multipart.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include <httplib.h>

#include "api/request_head.h"
#include "core/base/error.h"

namespace gaitmill::api {

namespace {

constexpr std::size_t kWindow = 256U << 10U;  // [bytes] read at once
constexpr std::size_t kMaxBoundary = 70;      // RFC 2046, 5.1.1
constexpr std::size_t kMaxPadding = 64;       // [bytes] of blanks behind a boundary
constexpr std::size_t kMaxName = 200;         // [bytes] of a part's name

void refuseUnless(bool ok, const std::string& message, const std::string& field = "body") {
  require(ok, ErrorCode::kRequestMalformed, message, {"", 0, 0, field});
}

bool isBoundaryLetter(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0 ||
         std::string_view("'()+_,-./:=? ").find(letter) != std::string_view::npos;
}

std::string_view skipBlanks(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  return text;
}

// Takes `"a \"b\""` or `token` off the front of `rest`. Browsers send "C:\walk.trc" unescaped, so a
// backslash escapes only a quote or itself.
std::string takeValue(std::string_view& rest) {
  std::string value;
  if (rest.empty() || rest.front() != '"') {
    const std::size_t end = std::min(rest.find_first_of("; \t"), rest.size());
    value = rest.substr(0, end);
    rest.remove_prefix(end);
    return value;
  }
  std::size_t at = 1;
  for (; at < rest.size() && rest[at] != '"'; ++at) {
    const bool escapes =
        rest[at] == '\\' && at + 1 < rest.size() && (rest[at + 1] == '"' || rest[at + 1] == '\\');
    at += escapes ? 1 : 0;
    value += rest[at];
  }
  refuseUnless(at < rest.size(), "a quoted parameter does not end");
  rest.remove_prefix(at + 1);
  return value;
}

// `form-data; name="a"; filename="b"` -> {name: a, filename: b}, names in lower case, first wins.
std::map<std::string, std::string> readParameters(std::string_view header) {
  std::map<std::string, std::string> parameters;
  std::string_view rest = header.substr(std::min(header.find(';'), header.size()));
  while (!rest.empty()) {
    rest = skipBlanks(rest);
    if (!rest.empty() && rest.front() == ';') {
      rest = skipBlanks(rest.substr(1));
    }
    const std::size_t equals = rest.find_first_of("=;");
    if (equals == std::string_view::npos || rest[equals] == ';') {
      rest.remove_prefix(std::min(equals, rest.size()));
      continue;
    }
    const std::string name = toLower(std::string(rest.substr(0, equals)));
    rest.remove_prefix(equals + 1);
    parameters.emplace(name, takeValue(rest));
    rest.remove_prefix(std::min(rest.find(';'), rest.size()));
  }
  return parameters;
}

// "UTF-8''na%C3%AFve.trc" of RFC 5987.
std::string decodeExtended(const std::string& value) {
  const std::size_t quote = value.rfind('\'');
  return quote == std::string::npos ? value
                                    : httplib::detail::decode_url(value.substr(quote + 1), false);
}

struct PartHeaders {
  std::string name;
  std::string file_name;
};

PartHeaders readPartHeaders(std::string_view headers) {
  PartHeaders part;
  bool has_name = false;
  while (!headers.empty()) {
    const std::size_t end = std::min(headers.find("\r\n"), headers.size());
    const std::string_view line = headers.substr(0, end);
    headers.remove_prefix(std::min(end + 2, headers.size()));
    const std::size_t colon = line.find(':');
    refuseUnless(colon != std::string_view::npos, "a part has a header without colon");
    if (toLower(std::string(line.substr(0, colon))) != "content-disposition") {
      continue;
    }
    refuseUnless(!std::exchange(has_name, true), "a part has two Content-Disposition headers");
    std::map<std::string, std::string> parameters = readParameters(line.substr(colon + 1));
    part.name = parameters["name"];
    part.file_name = parameters.count("filename*") > 0 ? decodeExtended(parameters["filename*"])
                                                       : parameters["filename"];
  }
  refuseUnless(!part.name.empty() && part.name.size() <= kMaxName,
               "every part needs a Content-Disposition with a name of at most " +
                   std::to_string(kMaxName) + " bytes");
  return part;
}

// Finds strings in a source through a window over it that only moves on, so that no bytes can make
// the search read a place more than twice.
class WindowedSearch {
 public:
  explicit WindowedSearch(const ByteSource& source) : source_(source) {}

  // Bytes [offset, offset + size), fewer at the end.
  std::string_view get(std::uint64_t offset, std::size_t size) {
    const std::uint64_t end = begin_ + window_.size();
    if (offset < begin_ || offset > end || (offset + size > end && end < source_.size())) {
      begin_ = offset;
      window_ = source_.read(offset, std::max(kWindow, size));
    }
    return std::string_view(window_).substr(static_cast<std::size_t>(offset - begin_), size);
  }

  // First place of `text` at or behind `from` that ends before `limit`.
  std::optional<std::uint64_t> find(std::string_view text,
                                    std::uint64_t from,
                                    std::uint64_t limit) {
    const std::uint64_t end = std::min(limit, source_.size());
    while (from + text.size() <= end && get(from, text.size()).size() == text.size()) {
      const auto at = static_cast<std::size_t>(from - begin_);
      const auto count =
          static_cast<std::size_t>(std::min<std::uint64_t>(window_.size() - at, end - from));
      // Linear whatever the bytes are, unlike std::string_view::find.
      const char* bytes = window_.data() + at;
      const void* hit = ::memmem(bytes, count, text.data(), text.size());
      if (hit != nullptr) {
        return from + static_cast<std::uint64_t>(static_cast<const char*>(hit) - bytes);
      }
      from += count - (text.size() - 1);
    }
    return std::nullopt;
  }

 private:
  const ByteSource& source_;
  std::uint64_t begin_ = 0;
  std::string window_;
};

class MultipartScanner {
 public:
  MultipartScanner(std::shared_ptr<const ByteSource> body,
                   const std::string& boundary,
                   const MultipartLimits& limits)
      : body_(std::move(body)), search_(*body_), delimiter_("\r\n--" + boundary), limits_(limits) {}

  std::vector<BodyPart> scan() {
    std::vector<BodyPart> parts;
    std::uint64_t at = findFirst();
    while (!isFinal(at)) {
      refuseUnless(parts.size() < limits_.parts,
                   "there may be " + std::to_string(limits_.parts) + " parts");
      at = readPart(at, parts);
    }
    refuseUnless(!parts.empty(), "the body has no parts");
    return parts;
  }

 private:
  // Behind the first boundary, which has no line before it.
  std::uint64_t findFirst() {
    const std::string_view first = std::string_view(delimiter_).substr(2);
    if (search_.get(0, first.size()) == first) {
      return first.size();
    }
    refuseUnless(search_.get(0, delimiter_.size()) == delimiter_,
                 "the body does not begin with the boundary that Content-Type names");
    return delimiter_.size();
  }

  bool isFinal(std::uint64_t behind_boundary) { return search_.get(behind_boundary, 2) == "--"; }

  // Behind the CRLF that ends a boundary's line, if it is one.
  std::optional<std::uint64_t> findLineEnd(std::uint64_t behind_boundary) {
    const std::string_view tail = search_.get(behind_boundary, kMaxPadding + 2);
    const std::size_t blanks = std::min(tail.find_first_not_of(" \t"), tail.size());
    return tail.substr(blanks, 2) == "\r\n" ? std::optional(behind_boundary + blanks + 2)
                                            : std::nullopt;
  }

  // Reads the part that begins behind a boundary. @returns where the next boundary ends
  std::uint64_t readPart(std::uint64_t behind_boundary, std::vector<BodyPart>& parts) {
    const std::optional<std::uint64_t> begin = findLineEnd(behind_boundary);
    refuseUnless(begin.has_value(), "a boundary is not alone on its line");
    const std::optional<std::uint64_t> empty_line =
        search_.find("\r\n\r\n", *begin, *begin + limits_.part_header_bytes);
    refuseUnless(empty_line.has_value(),
                 "a part has no headers, or more than " +
                     std::to_string(limits_.part_header_bytes) + " bytes of them");
    const PartHeaders headers =
        readPartHeaders(search_.get(*begin, static_cast<std::size_t>(*empty_line - *begin)));
    const std::uint64_t content = *empty_line + 4;
    const std::uint64_t end = findContentEnd(content);
    parts.push_back({headers.name, headers.file_name, makeSlice(body_, content, end - content)});
    return end + delimiter_.size();
  }

  // Where a boundary goes on as another word, readers differ on whether it is one (RFC 2046 says
  // yes): the next readPart() refuses it.
  std::uint64_t findContentEnd(std::uint64_t content) {
    const std::optional<std::uint64_t> end = search_.find(delimiter_, content, body_->size());
    refuseUnless(end.has_value(), "the final boundary is missing: the body was cut off");
    return *end;
  }

  std::shared_ptr<const ByteSource> body_;
  WindowedSearch search_;
  std::string delimiter_;
  MultipartLimits limits_;
};

}  // namespace

std::string findMultipartBoundary(const std::string& content_type) {
  const std::string boundary = readParameters(content_type)["boundary"];
  refuseUnless(!boundary.empty() && boundary.size() <= kMaxBoundary && boundary.back() != ' ' &&
                   std::all_of(boundary.begin(), boundary.end(), isBoundaryLetter),
               "multipart/form-data needs a boundary of 1 to 70 letters, digits or '()+_,-./:=?",
               "Content-Type");
  return boundary;
}

std::vector<BodyPart> scanMultipart(const std::shared_ptr<const ByteSource>& body,
                                    const std::string& boundary,
                                    const MultipartLimits& limits) {
  return MultipartScanner(body, boundary, limits).scan();
}

}  // namespace gaitmill::api

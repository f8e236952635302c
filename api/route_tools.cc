#include "api/route_tools.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstddef>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

#include "api/digest.h"
#include "api/dto/job.h"
#include "api/dto/object_reader.h"
#include "api/dto/timestamp.h"

namespace gaitmill::api {

namespace {

constexpr std::size_t kIdLetters = 26;
constexpr std::size_t kMaxNameLength = 200;
constexpr std::size_t kShownLength = 100;  // of what a message repeats from the request
constexpr std::uint64_t kMaxTextBytes = 16U << 20U;
constexpr int kMaxPage = 200;

bool isIdLetter(char letter) {
  return (letter >= '0' && letter <= '9') || (letter >= 'a' && letter <= 'z');
}

Error fieldError(const std::string& message, const std::string& field) {
  return {ErrorCode::kRequestField, message, {"", 0, 0, field}};
}

std::optional<std::int64_t> readTime(const HttpRequest& request, const char* name) {
  const std::string text = queryOf(request, name);
  if (text.empty()) {
    return std::nullopt;
  }
  const std::optional<std::int64_t> time = parseTimestamp(text);
  if (!time) {
    throw fieldError("a time is written like 2026-11-22T14:10:03Z (RFC 3339)", name);
  }
  return time;
}

std::string readName(const HttpRequest& request, const char* name) {
  std::string text = queryOf(request, name);
  if (!text.empty() && !isName(text)) {
    throw fieldError("the value must have 1 to 200 bytes on one line", name);
  }
  return text;
}

std::string readState(const HttpRequest& request) {
  static const Names states = {"queued", "running", "succeeded", "failed", "cancelled"};
  std::string state = queryOf(request, "state");
  if (!state.empty() && std::find(states.begin(), states.end(), state) == states.end()) {
    const std::string nearest = findNearestName(state, states);
    throw fieldError("a state is queued, running, succeeded, failed or cancelled" +
                         (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"),
                     "state");
  }
  return state;
}

std::string readId(const HttpRequest& request, const char* name, const char* prefix) {
  std::string id = queryOf(request, name);
  if (!id.empty() && !isId(id, prefix)) {
    throw fieldError(std::string("the value must be an id that begins with ") + prefix, name);
  }
  return id;
}

bool isPlainToken(const std::string& text) {
  return text.size() <= kShownLength && std::all_of(text.begin(), text.end(), [](char letter) {
           return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_' ||
                  letter == '-' || letter == '.';
         });
}

// RFC 6266: the plain name for old clients, the encoded one where it has other letters.
std::string makeDisposition(const std::string& name) {
  std::string plain;
  std::string encoded;
  constexpr const char* kDigits = "0123456789ABCDEF";
  for (const char letter : name) {
    const bool is_safe = isPlainToken(std::string(1, letter));
    const auto byte = static_cast<unsigned char>(letter);
    plain += is_safe || letter == ' ' ? letter : '_';
    encoded += is_safe ? std::string(1, letter)
                       : std::string{'%', kDigits[byte / 16U], kDigits[byte % 16U]};
  }
  const std::string header = "attachment; filename=\"" + plain + "\"";
  return plain == name ? header : header + "; filename*=UTF-8''" + encoded;
}

}  // namespace

Handler withQuery(Names known, Handler handler) {
  return [known = std::move(known), handler = std::move(handler)](HttpRequest& request) {
    for (const auto& [name, value] : request.query) {
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        const std::string nearest = findNearestName(name, known);
        throw fieldError("there is no parameter of this name" +
                             (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"),
                         name.substr(0, kShownLength));
      }
    }
    return handler(request);
  };
}

std::string queryOf(const HttpRequest& request, const std::string& name) {
  const auto found = request.query.find(name);
  return found == request.query.end() ? "" : found->second;
}

std::string bodyText(const HttpRequest& request) {
  return readAll(*request.body, kMaxTextBytes);
}

bool isId(const std::string& text, const std::string& prefix) {
  return text.size() == prefix.size() + kIdLetters && text.compare(0, prefix.size(), prefix) == 0 &&
         std::all_of(
             text.begin() + static_cast<std::ptrdiff_t>(prefix.size()), text.end(), isIdLetter);
}

const std::string& idOf(const HttpRequest& request, const char* prefix, ErrorCode not_found) {
  const std::string& id = request.captures.at("id");
  require(isId(id, prefix), not_found, "'" + id + "' does not exist", {"", 0, 0, "id"});
  return id;
}

HttpReply replyJson(int status, std::string json) {
  HttpReply reply;
  reply.status = status;
  reply.body = std::move(json);
  return reply;
}

HttpReply replyCreated(int status, const std::string& location, std::string json) {
  HttpReply reply = replyJson(status, std::move(json));
  reply.headers["Location"] = location;
  return reply;
}

HttpReply replyTagged(std::string json) {
  HttpReply reply = replyJson(200, std::move(json));
  reply.headers["ETag"] = "\"" + hashTexts({reply.body}).substr(0, 32) + "\"";
  return reply;
}

// The transport turns a reply into 304 by its tag; with an empty body nothing was made in vain.
HttpReply replyUnlessKnown(const HttpRequest& request,
                           const std::string& tag,
                           const std::function<HttpReply()>& make) {
  const std::string& known = request.header("if-none-match");
  const std::string compressed = tag.substr(0, tag.size() - 1) + "-gzip\"";
  HttpReply reply = known == tag || known == compressed ? HttpReply{} : make();
  reply.headers["ETag"] = tag;
  return reply;
}

HttpReply replyNothing() {
  HttpReply reply;
  reply.status = 204;
  reply.content_type.clear();
  return reply;
}

HttpReply replyFile(FileContent file, const std::string& content_type) {
  HttpReply reply;
  reply.content_type = content_type;
  reply.headers["Content-Disposition"] = makeDisposition(file.view.name);
  reply.headers["ETag"] = "\"" + file.view.sha256 + "\"";
  reply.source = std::move(file.bytes);
  return reply;
}

std::string makeLabel(const std::string& name, const std::string& fallback) {
  const std::size_t slash = name.find_last_of("/\\");
  const std::string base = slash == std::string::npos ? name : name.substr(slash + 1);
  std::string label;
  std::copy_if(base.begin(), base.end(), std::back_inserter(label), [](unsigned char letter) {
    return letter >= 0x20 && letter != 0x7f;
  });
  return label.empty() ? fallback : label.substr(0, kMaxNameLength);
}

std::string findSentName(const HttpRequest& request) {
  const std::string name = queryOf(request, "name");
  if (!name.empty()) {
    return makeLabel(name, "");
  }
  const std::string& disposition = request.header("content-disposition");
  const std::string key = "filename=\"";
  const std::size_t begin = disposition.find(key);
  if (begin == std::string::npos) {
    return "";
  }
  const std::size_t end = disposition.find('"', begin + key.size());
  return makeLabel(disposition.substr(begin + key.size(), end - begin - key.size()), "");
}

PageRequest readPage(const HttpRequest& request, const std::string& prefix) {
  PageRequest page;
  const std::string limit = queryOf(request, "limit");
  if (request.query.count("limit") > 0) {
    const char* const end = limit.data() + limit.size();
    const auto parsed = std::from_chars(limit.data(), end, page.limit);
    if (parsed.ec != std::errc() || parsed.ptr != end || page.limit < 1 || page.limit > kMaxPage) {
      throw fieldError("the limit must be a whole number from 1 to 200", "limit");
    }
  }
  page.cursor = queryOf(request, "cursor");
  const bool fits = page.cursor.empty() ||
                    (prefix.empty() ? isPlainToken(page.cursor) : isId(page.cursor, prefix));
  if (!fits) {
    throw fieldError("the cursor must be the next_cursor of the page before", "cursor");
  }
  return page;
}

ListFilter readFilter(const HttpRequest& request) {
  ListFilter filter;
  filter.state = readState(request);
  filter.subject = readName(request, "subject");
  filter.label = readName(request, "label");
  filter.trial_id = readId(request, "trial", "tri_");
  filter.study_id = readId(request, "study", "stu_");
  filter.created_after = readTime(request, "created_after");
  filter.created_before = readTime(request, "created_before");
  return filter;
}

}  // namespace gaitmill::api

#include "api/request_head.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {

// Bytes from the socket, before anybody is known to be allowed anything.
GAITMILL_FUZZ_TARGET(request_head) {
  const api::HeadLimits limits;
  tryParse([&] { api::checkPartialHead(input, limits); });
  const std::size_t end = api::findHeadEnd(input);
  if (end == std::string_view::npos) {
    return;
  }
  requirePromise(end <= input.size(), "a head ends within its bytes");
  const api::RequestHead head = api::parseRequestHead(input.substr(0, end), limits);
  requirePromise(end <= limits.header_bytes, "a long head is refused");
  requirePromise(head.headers.size() <= limits.headers, "many headers are refused");
  requirePromise(!head.path.empty() && head.path.front() == '/', "a path begins at the top");
  requirePromise(head.path.find('\0') == std::string::npos, "a path holds no zero byte");
  for (const auto& [name, value] : head.headers) {
    requirePromise(name == api::toLower(name), "names are in lower case");
    requirePromise(value.find_first_of(std::string_view("\r\n\0", 3)) == std::string::npos,
                   "a value is one line");
  }
  tryParse([&] { api::findMediaType(head.header("content-type")); });
}

}  // namespace gaitmill

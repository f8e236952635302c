#include <algorithm>
#include <memory>
#include <string>

#include "api/multipart.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {
namespace {

// The body stands where it is; reads beyond it are the scanner's fault.
class View : public api::ByteSource {
 public:
  explicit View(std::string_view bytes) : bytes_(bytes) {}
  std::uint64_t size() const override { return bytes_.size(); }
  std::string read(std::uint64_t offset, std::size_t size) const override {
    requirePromise(offset <= bytes_.size(), "nothing is read beyond the body");
    return std::string(bytes_.substr(offset, size));
  }

 private:
  std::string_view bytes_;
};

}  // namespace

// First line: the Content-Type. The rest: the body.
GAITMILL_FUZZ_TARGET(multipart) {
  const std::size_t line = std::min(input.find('\n'), input.size());
  const std::string boundary = api::findMultipartBoundary(std::string(input.substr(0, line)));
  requirePromise(!boundary.empty() && boundary.size() <= 70, "a boundary has 1 to 70 bytes");
  const std::string_view body = input.substr(std::min(line + 1, input.size()));
  const api::MultipartLimits limits;
  const auto parts = api::scanMultipart(std::make_shared<View>(body), boundary, limits);
  requirePromise(parts.size() <= limits.parts, "many parts are refused");
  std::uint64_t sum = 0;
  for (const api::BodyPart& part : parts) {
    requirePromise(!part.name.empty(), "a part has a name");
    sum += part.bytes->size();
    part.bytes->read(0, part.bytes->size());
  }
  requirePromise(sum <= body.size(), "parts do not overlap");
}

}  // namespace gaitmill

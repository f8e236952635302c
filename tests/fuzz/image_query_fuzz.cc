#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include "api/dto/image.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {

// The query of an image: "name=value&name=value", after a digit for the kind.
GAITMILL_FUZZ_TARGET(image_query) {
  const std::string text(input);
  std::map<std::string, std::string> parameters;
  for (std::size_t begin = 1; begin < text.size();) {
    const std::size_t end = std::min(text.find('&', begin), text.size());
    const std::string pair = text.substr(begin, end - begin);
    const std::size_t equals = pair.find('=');
    parameters[pair.substr(0, equals)] = equals == std::string::npos ? "" : pair.substr(equals + 1);
    begin = end + 1;
  }
  const int kind = text.empty() ? 0 : text.front() % 3;
  const api::ImageRequest request =
      api::parseImageRequest(static_cast<api::ImageKind>(kind), [&](const std::string& name) {
        const auto found = parameters.find(name);
        return found == parameters.end() ? std::nullopt : std::optional<std::string>(found->second);
      });
  requirePromise(request.width >= 16 && request.width <= 4096, "the width is within its range");
  requirePromise(request.poses >= 1 && request.poses <= 24, "so are the poses");
  requirePromise(request.rate > 0 && request.slow_down > 0, "an animation has an end");
}

}  // namespace gaitmill

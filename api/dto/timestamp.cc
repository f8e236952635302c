#include "api/dto/timestamp.h"

#include <array>
#include <ctime>

namespace gaitmill::api {

std::string formatTimestamp(std::int64_t milliseconds) {
  const auto seconds = static_cast<std::time_t>(milliseconds / 1000);
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &utc);
  const std::string fraction = std::to_string(1000 + milliseconds % 1000);
  return std::string(text.data()) + "." + fraction.substr(1) + "Z";
}

}  // namespace gaitmill::api

#pragma once

#include <cstdint>
#include <string>

namespace gaitmill::api {

/// "2026-11-22T14:10:03.250Z" for milliseconds since 1970 UTC, years 1970 to 9999.
std::string formatTimestamp(std::int64_t milliseconds);

}  // namespace gaitmill::api

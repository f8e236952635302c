#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace gaitmill::api {

/// "2026-11-22T14:10:03.250Z" for milliseconds since 1970 UTC, years 1970 to 9999.
std::string formatTimestamp(std::int64_t milliseconds);

/// Milliseconds since 1970 UTC of an RFC 3339 time such as "2026-11-22T15:10:03.25+01:00", finer
/// fractions cut off; nullopt if the text is none, or lies outside the years 1970 to 9999. A space
/// passes for the '+' of the offset, because that is what an unescaped '+' in a query becomes.
std::optional<std::int64_t> parseTimestamp(const std::string& text);

}  // namespace gaitmill::api

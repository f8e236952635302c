#pragma once

#include <string>

namespace gaitmill {

/// Sends the log to standard error, one line per event, times in UTC.
/// @param level  "debug", "info", "warn", "error" or "off"
/// @throws Error kUsage for another word
void setUpLog(const std::string& level);

}  // namespace gaitmill

#include "service/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include "core/base/error.h"

namespace gaitmill {

void setUpLog(const std::string& level) {
  const spdlog::level::level_enum parsed = spdlog::level::from_str(level);
  require(parsed != spdlog::level::off || level == "off",
          ErrorCode::kUsage,
          "the log level is debug, info, warn, error or off",
          {"", 0, 0, "log-level"});
  const auto sink = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  const auto logger = std::make_shared<spdlog::logger>("gaitmill", sink);
  logger->set_pattern("%Y-%m-%dT%H:%M:%S.%eZ %l %v", spdlog::pattern_time_type::utc);
  logger->set_level(parsed);
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(logger);
}

}  // namespace gaitmill

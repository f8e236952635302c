#include "service/observe/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <ctime>

#include <nlohmann/json.hpp>

#include "core/base/error.h"

namespace gaitmill {

namespace {

constexpr std::size_t kMaxValue = 2000;  // [bytes]

std::atomic<LogFormat>& currentFormat() {
  static std::atomic<LogFormat> format{LogFormat::kText};
  return format;
}

const char* nameOf(Severity severity) {
  switch (severity) {
    case Severity::kDebug:
      return "debug";
    case Severity::kInfo:
      return "info";
    case Severity::kWarn:
      return "warn";
    case Severity::kError:
      return "error";
  }
  return "error";
}

spdlog::level::level_enum levelOf(Severity severity) {
  switch (severity) {
    case Severity::kDebug:
      return spdlog::level::debug;
    case Severity::kInfo:
      return spdlog::level::info;
    case Severity::kWarn:
      return spdlog::level::warn;
    case Severity::kError:
      return spdlog::level::err;
  }
  return spdlog::level::err;
}

std::string formatTime(std::chrono::system_clock::time_point time) {
  using std::chrono::milliseconds;
  const auto since = time.time_since_epoch();
  const auto ms = std::chrono::duration_cast<milliseconds>(since).count() % 1000;
  const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
  std::tm parts{};
  ::gmtime_r(&seconds, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S", &parts);
  return fmt::format("{}.{:03}Z", text, ms);
}

// A JSON string in ASCII: control characters, DEL and everything beyond is escaped, so that no
// terminal and no line reader can be fooled.
std::string quote(const std::string& value) {
  const std::string cut = value.substr(0, kMaxValue);
  std::string text =
      nlohmann::json(cut).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  std::string out;
  for (const char letter : text) {
    letter == '\x7f' ? out += "\\u007f" : out += letter;
  }
  return out;
}

bool isPlain(const std::string& value) {
  const auto is_plain = [](char letter) {
    return letter > ' ' && letter < '\x7f' && letter != '"' && letter != '=' && letter != '\\';
  };
  return !value.empty() && value.size() <= kMaxValue &&
         std::all_of(value.begin(), value.end(), is_plain);
}

std::string formatJson(const std::string& time,
                       Severity severity,
                       std::string_view event,
                       std::initializer_list<LogField> fields) {
  std::string line =
      fmt::format(R"({{"time":"{}","level":"{}","event":"{}")", time, nameOf(severity), event);
  for (const LogField& field : fields) {
    line += ",\"" + field.name + "\":" + (field.is_number ? field.value : quote(field.value));
  }
  return line + "}";
}

}  // namespace

LogField::LogField(std::string_view field_name, double number)
    : name(field_name),
      value(std::isfinite(number) ? fmt::format("{:.6g}", number) : "null"),
      is_number(true) {}

LogField::LogField(std::string_view field_name, std::int64_t number)
    : name(field_name), value(std::to_string(number)), is_number(true) {}

LogField::LogField(std::string_view field_name, std::uint64_t number)
    : name(field_name), value(std::to_string(number)), is_number(true) {}

std::string formatLogLine(LogFormat format,
                          std::chrono::system_clock::time_point time,
                          Severity severity,
                          std::string_view event,
                          std::initializer_list<LogField> fields) {
  if (format == LogFormat::kJson) {
    return formatJson(formatTime(time), severity, event, fields);
  }
  std::string line = fmt::format("{} {} {}", formatTime(time), nameOf(severity), event);
  for (const LogField& field : fields) {
    line += " " + field.name + "=" + (isPlain(field.value) ? field.value : quote(field.value));
  }
  return line;
}

void setUpLog(const std::string& level, const std::string& format) {
  const spdlog::level::level_enum parsed = spdlog::level::from_str(level);
  require(parsed != spdlog::level::off || level == "off",
          ErrorCode::kUsage,
          "the log level is debug, info, warn, error or off",
          {"", 0, 0, "log-level"});
  require(format == "text" || format == "json",
          ErrorCode::kUsage,
          "the log format is text or json",
          {"", 0, 0, "log-format"});
  currentFormat() = format == "json" ? LogFormat::kJson : LogFormat::kText;
  const auto sink = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  const auto logger = std::make_shared<spdlog::logger>("gaitmill", sink);
  logger->set_pattern("%v");
  logger->set_level(parsed);
  logger->flush_on(spdlog::level::info);
  spdlog::set_default_logger(logger);
}

void logEvent(Severity severity, std::string_view event, std::initializer_list<LogField> fields) {
  spdlog::logger* const logger = spdlog::default_logger_raw();
  if (logger->should_log(levelOf(severity))) {
    logger->log(
        levelOf(severity),
        "{}",
        formatLogLine(currentFormat(), std::chrono::system_clock::now(), severity, event, fields));
  }
}

}  // namespace gaitmill

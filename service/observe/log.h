#pragma once

#include <chrono>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

namespace gaitmill {

enum class Severity { kDebug, kInfo, kWarn, kError };
enum class LogFormat { kText, kJson };

/// One member of a log line. Names are those of all lines: request_id, job_id, trial_id, study_id,
/// tenant, key_id, stage, code, message, seconds [s], ...
struct LogField {
  LogField(std::string_view field_name, std::string_view text) : name(field_name), value(text) {}
  LogField(std::string_view field_name, const char* text) : name(field_name), value(text) {}
  LogField(std::string_view field_name, double number);
  LogField(std::string_view field_name, int number) : LogField(field_name, std::int64_t{number}) {}
  LogField(std::string_view field_name, std::int64_t number);
  LogField(std::string_view field_name, std::uint64_t number);

  std::string name;
  std::string value;
  bool is_number = false;
};

/// One line of the log, without its end. Whatever the values hold, it stays one line of printable
/// text: control characters, quotes and broken UTF-8 are escaped, long values are cut.
///   text  2026-05-04T10:11:12.345Z warn job.failed job_id=job_7 message="markers are missing"
///   json  {"time":"…","level":"warn","event":"job.failed","job_id":"job_7","message":"…"}
std::string formatLogLine(LogFormat format,
                          std::chrono::system_clock::time_point time,
                          Severity severity,
                          std::string_view event,
                          std::initializer_list<LogField> fields);

/// Sends the log to standard error, times in UTC.
/// @param level   "debug", "info", "warn", "error" or "off"
/// @param format  "text" or "json"
/// @throws Error kUsage for another word
void setUpLog(const std::string& level, const std::string& format = "text");

/// Writes one line, if the level asks for it. From any thread. Secrets and contents of files have
/// no place in a log.
/// @param event  what has happened, as a stable dotted name: "job.succeeded"
void logEvent(Severity severity,
              std::string_view event,
              std::initializer_list<LogField> fields = {});

}  // namespace gaitmill

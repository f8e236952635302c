#include "service/observe/log.h"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"

namespace gaitmill {
namespace {

const auto kTime = std::chrono::system_clock::time_point(std::chrono::milliseconds(1'500));

TEST(LogLine, HasTimeLevelEventAndMembers) {
  EXPECT_EQ(formatLogLine(LogFormat::kText,
                          kTime,
                          Severity::kWarn,
                          "job.failed",
                          {{"job_id", "job_7"}, {"seconds", 1.25}, {"message", "two words"}}),
            "1970-01-01T00:00:01.500Z warn job.failed job_id=job_7 seconds=1.25 "
            "message=\"two words\"");
  EXPECT_EQ(formatLogLine(LogFormat::kJson,
                          kTime,
                          Severity::kInfo,
                          "job.failed",
                          {{"job_id", "job_7"}, {"seconds", 1.25}}),
            R"({"time":"1970-01-01T00:00:01.500Z","level":"info","event":"job.failed",)"
            R"("job_id":"job_7","seconds":1.25})");
}

// A value that tries to end its line and to begin another one, or to speak to a terminal.
TEST(LogLine, HostileValuesStayOnTheirLine) {
  std::string hostile = "a\nb\r\x1b[31m\"quoted\\\x7f\xff\xc3";
  hostile.push_back('\0');
  for (const LogFormat format : {LogFormat::kText, LogFormat::kJson}) {
    const std::string line =
        formatLogLine(format, kTime, Severity::kInfo, "event", {{"path", hostile}});
    for (const char letter : line) {
      EXPECT_TRUE(letter >= ' ' && letter < '\x7f') << line;
    }
    if (format == LogFormat::kJson) {
      EXPECT_EQ(nlohmann::json::parse(line)["path"].get<std::string>().substr(0, 3), "a\nb");
    }
  }
}

TEST(LogLine, LongValuesAreCut) {
  const std::string line = formatLogLine(
      LogFormat::kText, kTime, Severity::kInfo, "event", {{"path", std::string(100'000, 'x')}});
  EXPECT_LT(line.size(), 3'000U);
}

TEST(Log, UnknownWordsAreRefused) {
  EXPECT_THROW(setUpLog("loud"), Error);
  EXPECT_THROW(setUpLog("info", "xml"), Error);
  setUpLog("off");
}

}  // namespace
}  // namespace gaitmill

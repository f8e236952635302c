#include "service/command_line.h"

#include <stdlib.h>

#include <string>

#include <gtest/gtest.h>

namespace gaitmill {
namespace {

template <class T>
T parseAs(const std::vector<std::string>& arguments) {
  const Command command = parseCommandLine(arguments);
  const auto* parsed = std::get_if<T>(&command);
  EXPECT_NE(parsed, nullptr) << arguments[0];
  return parsed == nullptr ? T() : *parsed;
}

TEST(CommandLine, ServeTakesFlagsThenVariablesThenDefaults) {
  ::setenv("GAITMILL_WORKERS", "3", 1);
  ::setenv("GAITMILL_PORT", "81", 1);
  const auto config = parseAs<ServeConfig>({"serve", "--port", "0", "--db", "x.db"});
  ::unsetenv("GAITMILL_WORKERS");
  ::unsetenv("GAITMILL_PORT");
  EXPECT_EQ(config.database, "x.db");
  EXPECT_EQ(config.port, 0);
  EXPECT_EQ(config.workers, 3);
  EXPECT_EQ(config.host, "127.0.0.1");
}

TEST(CommandLine, RunTakesFilesAndStage) {
  const std::string file = "CMakeLists.txt";
  const auto run = parseAs<RunOptions>({"run",
                                        "--settings",
                                        "paper_walk",
                                        "--markers",
                                        file,
                                        "--grf",
                                        file,
                                        "--mass",
                                        "75.3",
                                        "--height",
                                        "1.7",
                                        "--from",
                                        "rra",
                                        "--coordinates",
                                        file,
                                        "--out",
                                        "o"});
  EXPECT_EQ(run.settings, "paper_walk");
  EXPECT_EQ(run.from, "rra");
  EXPECT_EQ(run.coordinates, file);
  EXPECT_EQ(run.mass, 75.3);
  EXPECT_EQ(run.emg, "");
}

TEST(CommandLine, ModelAndSampleHaveTheirFlags) {
  EXPECT_EQ(parseAs<ModelOptions>({"model", "--json"}).report, ModelReport::kJson);
  EXPECT_EQ(parseAs<ModelOptions>({"model", "CMakeLists.txt"}).path, "CMakeLists.txt");
  EXPECT_EQ(parseAs<SampleOptionsOnDisk>({"sample", "--out", "d", "--truth"}).content,
            SampleOptionsOnDisk::Content::kWithTruth);
  parseAs<VersionOptions>({"version"});
}

TEST(CommandLine, HelpIsEverywhereAndStatesTheExitCodes) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                    {"serve", "--help"},
                                                    {"run", "--help"},
                                                    {"model", "--help"},
                                                    {"sample", "--help"},
                                                    {"version", "--help"}}) {
    const auto help = parseAs<PrintAndExit>(arguments);
    EXPECT_EQ(help.exit_code, kExitSuccess);
    EXPECT_NE(help.text.find("Exit codes: 0 success"), std::string::npos) << arguments[0];
  }
}

TEST(CommandLine, WrongUsageIsExitCodeTwo) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                    {"fly"},
                                                    {"serve", "--port", "70000"},
                                                    {"serve", "--prot", "1"},
                                                    {"run", "--mass", "75"},
                                                    {"model", "absent.osim"},
                                                    {"sample"}}) {
    const auto message = parseAs<PrintAndExit>(arguments);
    EXPECT_EQ(message.exit_code, kExitUsage);
    EXPECT_NE(message.text, "");
  }
}

}  // namespace
}  // namespace gaitmill

#include "service/command_line.h"

#include <stdlib.h>

#include <map>
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
  const ServeConfig config =
      parseAs<ServeOptions>({"serve", "--port", "0", "--db", "x.db"}).configuration.values;
  ::unsetenv("GAITMILL_WORKERS");
  ::unsetenv("GAITMILL_PORT");
  EXPECT_EQ(config.db, "x.db");
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

TEST(CommandLine, RenderTakesItsParametersAsTheyAre) {
  const auto render = parseAs<RenderOptions>({"render",
                                              "out.png",
                                              "--model",
                                              "README.md",
                                              "--motion",
                                              "README.md",
                                              "--percent",
                                              "50",
                                              "--slow-down",
                                              "4",
                                              "--view",
                                              "30,10"});
  EXPECT_EQ(render.out, "out.png");
  EXPECT_EQ(render.motion, "README.md");
  EXPECT_EQ(render.parameters,
            (std::map<std::string, std::string>{
                {"percent", "50"}, {"slow_down", "4"}, {"view", "30,10"}}));
}

TEST(CommandLine, ValidationTakesModelAndFigure) {
  const auto validation = parseAs<ValidateModelOptions>(
      {"model", "validation", "README.md", "curves", "--seed", "7", "--format", "svg"});
  EXPECT_EQ(validation.path, "README.md");
  EXPECT_EQ(validation.figure, "curves");
  EXPECT_EQ(validation.seed, 7U);
  EXPECT_EQ(validation.form, ValidateModelOptions::Form::kSvg);
}

TEST(CommandLine, ModelAndSampleHaveTheirFlags) {
  EXPECT_EQ(parseAs<ModelOptions>({"model", "--json"}).report, ModelReport::kJson);
  EXPECT_EQ(parseAs<ModelOptions>({"model", "CMakeLists.txt"}).path, "CMakeLists.txt");
  const auto calibrate = parseAs<CalibrateOptions>(
      {"model", "calibrate", "CMakeLists.txt", "--targets", "README.md", "-o", "out.osim"});
  EXPECT_EQ(calibrate.path, "CMakeLists.txt");
  EXPECT_EQ(calibrate.targets, "README.md");
  EXPECT_EQ(calibrate.out, "out.osim");
  EXPECT_EQ(parseAs<CalibrateOptions>({"model", "calibrate"}).path, "");
  EXPECT_EQ(parseAs<SampleOptionsOnDisk>({"sample", "--out", "d", "--truth"}).content,
            SampleOptionsOnDisk::Content::kWithTruth);
  parseAs<VersionOptions>({"version"});
}

TEST(CommandLine, OperatorsHaveTheirCommands) {
  EXPECT_EQ(parseAs<ServeOptions>({"work", "--db", "x.db"}).action, ServeOptions::Action::kWork);
  EXPECT_EQ(parseAs<ServeOptions>({"serve", "--print-config"}).action,
            ServeOptions::Action::kPrintConfig);
  EXPECT_EQ(parseAs<BackupOptions>({"backup", "b.db", "--db", "x.db"}).database, "x.db");
  EXPECT_EQ(parseAs<RestoreOptions>({"restore", "CMakeLists.txt", "--overwrite"}).overwrite,
            RestoreOptions::Overwrite::kYes);
  const auto keys = parseAs<KeysOptions>(
      {"keys", "create", "--name", "lab", "--scopes", "read,admin", "--db", "x.db"});
  EXPECT_EQ(keys.database, "x.db");
  EXPECT_EQ(std::get<CreateKeyOptions>(keys.action).scopes,
            (std::vector<std::string>{"read", "admin"}));
  EXPECT_EQ(
      std::get<RevokeKeyOptions>(parseAs<KeysOptions>({"keys", "revoke", "key_1"}).action).key_id,
      "key_1");
}

TEST(CommandLine, ChildrenAreNotForPeople) {
  const auto child = parseAs<ChildOptions>(
      {"solve", "--models", "m", "--parent", "7", "--memory-mb", "100", "--nice", "3"});
  EXPECT_EQ(child.parent, 7);
  EXPECT_EQ(child.limits.memory_mb, 100);
  EXPECT_EQ(parseAs<PrintAndExit>({"--help"}).text.find("solve"), std::string::npos);
}

TEST(CommandLine, HelpIsEverywhereAndStatesTheExitCodes) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                    {"serve", "--help"},
                                                    {"work", "--help"},
                                                    {"backup", "--help"},
                                                    {"restore", "--help"},
                                                    {"keys", "--help"},
                                                    {"run", "--help"},
                                                    {"model", "--help"},
                                                    {"model", "calibrate", "--help"},
                                                    {"model", "validation", "--help"},
                                                    {"render", "--help"},
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

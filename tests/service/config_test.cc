#include "service/config.h"

#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "tests/support/temporary_folder.h"

namespace gaitmill {
namespace {

using nlohmann::json;

Environment makeEnvironment(std::map<std::string, std::string> variables) {
  return [variables](const std::string& name) -> std::optional<std::string> {
    const auto found = variables.find(name);
    return found == variables.end() ? std::nullopt : std::optional<std::string>(found->second);
  };
}

template <class Action>
Error catchError(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "nothing was refused";
  return Error(ErrorCode::kInternal, "");
}

TEST(Configuration, FlagsWinOverVariablesAndThoseOverTheFile) {
  const TemporaryFolder folder;
  folder.write("c.json", R"({"db": "file.db", "port": 1, "workers": 1, "lease_s": 2.5})");
  const Configuration configuration =
      loadConfiguration({{"db", "flag.db"}},
                        folder / "c.json",
                        makeEnvironment({{"GAITMILL_DB", "variable.db"}, {"GAITMILL_PORT", "2"}}));
  EXPECT_EQ(configuration.values.db, "flag.db");
  EXPECT_EQ(configuration.values.port, 2);
  EXPECT_EQ(configuration.values.workers, 1);
  EXPECT_EQ(configuration.values.lease_s, 2.5);
  const json printed = json::parse(printConfiguration(configuration));
  EXPECT_EQ(printed["db"]["source"], "flag");
  EXPECT_EQ(printed["port"]["source"], "environment");
  EXPECT_EQ(printed["workers"]["source"], "file");
  EXPECT_EQ(printed["host"]["source"], "default");
  EXPECT_EQ(printed["lease_s"]["value"], 2.5);
  EXPECT_EQ(printed["lease_s"]["unit"], "s");
  EXPECT_EQ(printed.size(), configFields().size());
}

TEST(Configuration, UnknownFieldsAreRefusedWithTheNearestName) {
  const TemporaryFolder folder;
  folder.write("c.json", R"({"prot": 1})");
  const Error error =
      catchError([&] { loadConfiguration({}, folder / "c.json", makeEnvironment({})); });
  EXPECT_EQ(error.code(), ErrorCode::kConfig);
  EXPECT_EQ(error.where().field, "prot");
  EXPECT_EQ(error.where().file, folder / "c.json");
  EXPECT_NE(error.message().find("did you mean 'port'?"), std::string::npos);
}

TEST(Configuration, WrongValuesAreRefusedWithWhatIsAllowed) {
  const TemporaryFolder folder;
  for (const auto& [text, field] :
       std::map<std::string, std::string>{{R"({"port": 70000})", "port"},
                                          {R"({"port": 1.5})", "port"},
                                          {R"({"port": "80"})", "port"},
                                          {R"({"db": 3})", "db"},
                                          {R"({"log_level": "loud"})", "log_level"}}) {
    folder.write("c.json", text);
    const Error error =
        catchError([&] { loadConfiguration({}, folder / "c.json", makeEnvironment({})); });
    EXPECT_EQ(error.code(), ErrorCode::kConfig) << text;
    EXPECT_EQ(error.where().field, field) << text;
  }
  folder.write("c.json", "{\n\"port\": ,\n}");
  EXPECT_EQ(catchError([&] { loadConfiguration({}, folder / "c.json", makeEnvironment({})); })
                .where()
                .line,
            2);
  Configuration untouched;
  EXPECT_EQ(
      catchError([&] { applyConfigFile(R"({"lease_s": 1e999})", "c.json", untouched); }).code(),
      ErrorCode::kConfig);
  EXPECT_EQ(catchError([] {
              loadConfiguration({}, "", makeEnvironment({{"GAITMILL_WORKERS", "many"}}));
            }).context(),
            std::vector<std::string>{"reading GAITMILL_WORKERS"});
}

TEST(Configuration, EveryFieldIsNamedOnceAndExplained) {
  std::set<std::string> names;
  for (const ConfigField& field : configFields()) {
    EXPECT_TRUE(names.insert(field.name).second) << field.name;
    EXPECT_FALSE(field.help.empty()) << field.name;
    EXPECT_LE(field.lowest, field.highest) << field.name;
  }
}

TEST(Configuration, OnlyLoopbackAddressesAreLoopback) {
  for (const char* host : {"127.0.0.1", "127.9.9.9", "localhost", "::1"}) {
    EXPECT_TRUE(isLoopback(host)) << host;
  }
  for (const char* host :
       {"0.0.0.0", "192.168.0.1", "::", "example.org", "127.example.org", "127.1.1.1.org", ""}) {
    EXPECT_FALSE(isLoopback(host)) << host;
  }
}

}  // namespace
}  // namespace gaitmill

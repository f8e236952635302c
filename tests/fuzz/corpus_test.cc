// Every file of tests/fuzz/corpus through its target: what the fuzzers once found stays found, and
// every seed of theirs is a valid input of some kind.

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/io/files.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {
namespace {

std::vector<std::string> listCorpus(const std::string& target) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator("tests/fuzz/corpus/" + target)) {
    files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

class FuzzCorpus : public ::testing::TestWithParam<FuzzTarget> {};

TEST_P(FuzzCorpus, IsReadOrRefused) {
  const std::vector<std::string> files = listCorpus(GetParam().name);
  EXPECT_FALSE(files.empty());
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    const std::string bytes = readFile(file);
    // A copy of exactly this size, so that the address sanitizer sees a read beyond it.
    const auto copy = std::make_unique<char[]>(bytes.size());
    std::copy(bytes.begin(), bytes.end(), copy.get());
    EXPECT_NO_THROW(tryParse([&] { GetParam().body({copy.get(), bytes.size()}); }));
  }
}

INSTANTIATE_TEST_SUITE_P(Targets,
                         FuzzCorpus,
                         ::testing::ValuesIn(fuzzTargets()),
                         [](const auto& target) { return target.param.name; });

}  // namespace
}  // namespace gaitmill

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/architecture/include_rules.h"

namespace gaitmill {
namespace {

std::vector<IncludeViolation> check(const std::string& file, const std::string& include) {
  return checkIncludes(file, {include});
}

// The rules themselves, on invented files: one wrong arrow per row.
TEST(IncludeRules, NameTheFileTheIncludeAndTheRule) {
  const auto found = check("core/ik/ik_solver.cc", "core/id/id_solver.h");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].file, "core/ik/ik_solver.cc");
  EXPECT_EQ(found[0].include, "core/id/id_solver.h");
  EXPECT_EQ(found[0].rule, "core/ik may not include core/id");
}

struct Arrow {
  const char* file;
  const char* include;
};

class ForbiddenArrow : public ::testing::TestWithParam<Arrow> {};
TEST_P(ForbiddenArrow, IsFound) {
  EXPECT_EQ(check(GetParam().file, GetParam().include).size(), 1U)
      << GetParam().file << " -> " << GetParam().include;
}
INSTANTIATE_TEST_SUITE_P(
    Table,
    ForbiddenArrow,
    ::testing::Values(Arrow{"core/base/error.cc", "core/data/time_series.h"},
                      Arrow{"core/data/model_spec.h", "core/model/model.h"},
                      Arrow{"core/math/qp.cc", "core/model/model.h"},
                      Arrow{"core/io/trc.cc", "core/scale/scale_solver.h"},
                      Arrow{"core/muscle/muscle.h", "core/model/model.h"},
                      Arrow{"core/model/model.cc", "core/ik/ik_solver.h"},
                      Arrow{"core/rra/rra_solver.cc", "core/cmc/cmc_solver.h"},
                      Arrow{"core/cmc/cmc_solver.cc", "core/io/sto_writer.h"},
                      Arrow{"core/analysis/moments.cc", "core/cmc/cmc_solver.h"},
                      Arrow{"core/pipeline/pipeline.cc", "api/dto/job.h"},
                      Arrow{"core/pipeline/pipeline.cc", "service/queue.h"},
                      Arrow{"api/routes/jobs.cc", "core/pipeline/pipeline.h"},
                      Arrow{"api/routes/jobs.cc", "service/queue.h"},
                      Arrow{"service/workers.cc", "core/cmc/cmc_solver.h"},
                      Arrow{"core/new_room/file.cc", "core/base/error.h"},
                      Arrow{"core/model/model.h", "Simbody.h"},
                      Arrow{"core/cmc/cmc_solver.cc", "simbody/internal/MobilizedBody.h"},
                      Arrow{"core/so/so_solver.cc", "coin/IpIpoptApplication.hpp"},
                      Arrow{"core/math/nlp.h", "IpTNLP.hpp"},
                      Arrow{"service/main.cc", "sqlite3.h"},
                      Arrow{"service/main.cc", "httplib.h"},
                      Arrow{"core/analysis/picture.cc", "GL/osmesa.h"},
                      Arrow{"core/model/model.cc", "fstream"},
                      Arrow{"core/ik/ik_solver.cc", "filesystem"},
                      Arrow{"core/ik/ik_solver.cc", "iostream"},
                      Arrow{"core/cmc/cmc_solver.cc", "cstdio"},
                      Arrow{"core/data/model_spec.cc", "pugixml.hpp"},
                      Arrow{"core/scale/scale_options.cc", "nlohmann/json.hpp"}));

class AllowedArrow : public ::testing::TestWithParam<Arrow> {};
TEST_P(AllowedArrow, Passes) {
  EXPECT_TRUE(check(GetParam().file, GetParam().include).empty())
      << GetParam().file << " -> " << GetParam().include;
}
INSTANTIATE_TEST_SUITE_P(Table,
                         AllowedArrow,
                         ::testing::Values(Arrow{"core/ik/ik_solver.cc", "core/ik/ik_options.h"},
                                           Arrow{"core/ik/ik_solver.cc", "core/model/model.h"},
                                           Arrow{"core/model/model.cc", "Simbody.h"},
                                           Arrow{"core/math/nlp.cc", "coin/IpTNLP.hpp"},
                                           Arrow{"core/io/file.cc", "fstream"},
                                           Arrow{"core/pipeline/pipeline.cc",
                                                 "core/cmc/cmc_solver.h"},
                                           Arrow{"api/server.cc", "httplib.h"},
                                           Arrow{"service/storage/jobs.cc", "sqlite3.h"},
                                           Arrow{"service/main.cc", "core/pipeline/pipeline.h"}));

TEST(IncludeRules, ReadBothKindsOfDirective) {
  const std::string source =
      "#pragma once\n#include <vector>\n  #  include \"core/base/error.h\" // why\nint x;\n";
  EXPECT_EQ(findIncludes(source), (std::vector<std::string>{"vector", "core/base/error.h"}));
}

std::string readFile(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// The tree as it is. The test runs in the repository's top folder.
TEST(Architecture, EveryIncludePointsTheAllowedWay) {
  int files = 0;
  for (const char* folder : {"core", "api", "service"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      const std::string extension = entry.path().extension().string();
      if (!entry.is_regular_file() || (extension != ".h" && extension != ".cc")) {
        continue;
      }
      ++files;
      const std::string file = entry.path().generic_string();
      for (const IncludeViolation& v : checkIncludes(file, findIncludes(readFile(entry.path())))) {
        ADD_FAILURE() << v.file << " includes " << v.include << ": " << v.rule;
      }
    }
  }
  EXPECT_GT(files, 10) << "the test must run in the repository's top folder";
}

}  // namespace
}  // namespace gaitmill

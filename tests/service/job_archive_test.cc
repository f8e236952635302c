#include "service/job_archive.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "service/storage/sha256.h"
#include "tests/service/port_fixture.h"
#include "tests/service/zip_reader.h"

namespace gaitmill {
namespace {

using nlohmann::json;

class JobArchiveTest : public ::testing::Test {
 protected:
  std::string makeZipOf(const std::string& job_id) {
    return readSource(*fixture_.ports().results.makeArchive(who_, job_id).bytes);
  }

  PortFixture fixture_;
  const api::Identity who_ = makeMember("gait lab");
};

TEST_F(JobArchiveTest, HoldsEverythingOfTheJob) {
  const std::string id = fixture_.addFinishedJob(who_, R"({"steps": 3})");
  std::map<std::string, std::string> files;
  for (const auto& [name, bytes] : readZip(makeZipOf(id))) {
    files[name] = bytes;
  }
  EXPECT_EQ(files["inputs/markers/walk.trc"], "the bytes");
  EXPECT_EQ(files["files/scaled_model.osim"], "the bytes");
  EXPECT_EQ(json::parse(files["settings.json"]), (json{{"steps", 3}}));
  EXPECT_EQ(files["results/moments.csv"],
            "time [s],hip_flexion_r [N.m],hip_angle [rad]\n0,1.5,0.1\n0.5,,0.2\n1,-2,0.3\n");
  EXPECT_EQ(json::parse(files["results/moments.json"])["columns"][0]["name"], "hip_flexion_r");
  EXPECT_NE(files["results/moments.sto"], "");
  EXPECT_NE(files["results/moments_cycle.csv"], "");
  EXPECT_TRUE(json::parse(files["results/quality.json"]).contains("moments"));
  EXPECT_NE(files["CITATION"].find("10.1109/TBME.2016.2586891"), std::string::npos);
  EXPECT_TRUE(json::parse(files["plots/moments.vl.json"]).contains("$schema"));
  EXPECT_NE(files["report.html"].find(id), std::string::npos);
  EXPECT_NE(files["images/right_heel_strike.png"], "");
  EXPECT_NE(files["images/right_toe_off.png"], "");
  const json provenance = json::parse(files["provenance.json"]);
  EXPECT_EQ(provenance["provenance_sha256"], fixture_.ports().jobs.find(who_, id).provenance);
  EXPECT_EQ(provenance["inputs_sha256"]["markers"], calcSha256("the bytes"));
  EXPECT_EQ(provenance["code"].get<std::string>().rfind("gaitmill ", 0), 0U);
}

TEST_F(JobArchiveTest, ChecksumsCoverEveryOtherFile) {
  auto files = readZip(makeZipOf(fixture_.addFinishedJob(who_)));
  ASSERT_EQ(files.back().first, "SHA256SUMS");
  std::set<std::string> expected;
  for (std::size_t i = 0; i + 1 < files.size(); ++i) {
    expected.insert(calcSha256(files[i].second) + "  " + files[i].first);
  }
  std::set<std::string> lines;
  std::string line;
  for (std::istringstream sums(files.back().second); std::getline(sums, line);) {
    lines.insert(line);
  }
  EXPECT_EQ(lines, expected);
}

// The report names the job and its times; everything else is the same.
TEST_F(JobArchiveTest, EqualJobsGiveEqualBytes) {
  const auto read_all = [this] {
    std::map<std::string, std::string> files;
    for (const auto& [name, bytes] : readZip(makeZipOf(fixture_.addFinishedJob(who_)))) {
      files[name] = bytes;
    }
    EXPECT_EQ(files.erase("report.html"), 1U);
    files.erase("SHA256SUMS");
    return files;
  };
  const auto first = read_all();
  fixture_.reopen();
  EXPECT_EQ(read_all(), first);
}

TEST_F(JobArchiveTest, HashOfTheViewIsThatOfTheBytes) {
  const std::string id = fixture_.addFinishedJob(who_);
  const api::FileContent archive = fixture_.ports().results.makeArchive(who_, id);
  const std::string bytes = readSource(*archive.bytes);
  EXPECT_EQ(archive.view.name, id + ".zip");
  EXPECT_EQ(archive.view.sha256, calcSha256(bytes));
  EXPECT_EQ(archive.view.size, static_cast<std::int64_t>(bytes.size()));
}

TEST_F(JobArchiveTest, ManyArchivesAskedForInTurnAreEachTheirOwn) {
  std::vector<std::string> ids;
  for (int i = 0; i < 6; ++i) {
    ids.push_back(fixture_.addFinishedJob(who_, json{{"steps", i + 1}}.dump()));
  }
  std::set<std::string> archives;
  for (int round = 0; round < 2; ++round) {
    for (const std::string& id : ids) {
      archives.insert(makeZipOf(id));
    }
  }
  EXPECT_EQ(archives.size(), ids.size());
}

}  // namespace
}  // namespace gaitmill

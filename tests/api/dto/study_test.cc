#include "api/dto/study.h"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"

namespace gaitmill::api {
namespace {

class BadStudy : public ::testing::TestWithParam<const char*> {};
TEST_P(BadStudy, IsRefusedWithItsField) {
  try {
    parseStudyRequest(GetParam());
    FAIL() << GetParam();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kRequestField);
    EXPECT_NE(error.where().field, "");
  }
}
INSTANTIATE_TEST_SUITE_P(Table,
                         BadStudy,
                         ::testing::Values(R"({"trials": ["t"]})",
                                           R"({"name": "s"})",
                                           R"({"name": "s", "trials": []})",
                                           R"({"name": "s", "trials": "t"})",
                                           R"({"name": "s", "trials": [3]})",
                                           R"({"name": "s", "trials": ["t", "t"]})",
                                           R"({"name": "s", "trials": ["t"], "settings": []})",
                                           R"({"name": "s", "trials": ["t"], "settings": [3]})",
                                           R"({"name": "s", "trials": ["t"], "jobs": []})"));

TEST(ParseStudyRequest, OneNameOrDocumentNeedsNoList) {
  EXPECT_EQ(parseStudyRequest(R"({"name": "s", "trials": ["t"]})").jobs[0].settings_name,
            "default");
  EXPECT_EQ(
      parseStudyRequest(R"({"name": "s", "trials": ["t"], "settings": "a"})").jobs[0].settings_name,
      "a");
  EXPECT_EQ(
      parseStudyRequest(R"({"name": "s", "trials": ["t"], "settings": {}})").jobs[0].settings_json,
      "{}");
}

TEST(ParseStudyRequest, BoundsTheNumberOfJobs) {
  nlohmann::json study{{"name", "s"}, {"settings", {"a", "b"}}};
  for (int i = 0; i < 500; ++i) {
    study["trials"].push_back("t" + std::to_string(i));
  }
  EXPECT_EQ(parseStudyRequest(study.dump()).jobs.size(), 1000U);
  study["trials"].push_back("one more");
  EXPECT_THROW(parseStudyRequest(study.dump()), Error);
}

TEST(RenderStudy, IsFinishedWhenNothingWaitsOrRuns) {
  StudyView study;
  study.jobs = {{"succeeded", 2}, {"running", 1}};
  EXPECT_EQ(nlohmann::json::parse(renderStudy(study))["finished"], false);
  study.jobs["running"] = 0;
  const auto json = nlohmann::json::parse(renderStudy(study));
  EXPECT_EQ(json["finished"], true);
  EXPECT_EQ(json["job_counts"]["failed"], 0);
}

}  // namespace
}  // namespace gaitmill::api

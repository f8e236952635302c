// What the routes of results and studies ask for, and what they make of the answer.

#include <set>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/api/route_fixture.h"

namespace gaitmill::api {
namespace {

using nlohmann::json;

class ResultRoutes : public RouteFixture {
 protected:
  const std::string path_ = job_ + "/results/kinematics";
  const std::string study_ = std::string("/v1/studies/") + kStudyId;
};

TEST_F(ResultRoutes, FormatFollowsParameterThenAccept) {
  EXPECT_EQ(get(path_).content_type, "application/json");
  EXPECT_EQ(get(path_, {{"format", "csv"}}).content_type, "text/csv; charset=utf-8");
  EXPECT_EQ(get(path_, {{"format", "sto"}}).body, "kinematics rad");
  HttpRequest request;
  request.headers["accept"] = "application/vnd.opensim.sto, */*;q=0.1";
  EXPECT_EQ(call("GET", path_, request).body, "kinematics rad");
  request.query["format"] = "csv";
  EXPECT_EQ(call("GET", path_, request).headers.at("Vary"), "Accept");
  EXPECT_EQ(call("GET", path_, request).content_type, "text/csv; charset=utf-8");
}

TEST_F(ResultRoutes, TableSaysWhatItComesFrom) {
  stub_.record.is_final = false;
  const json table = json::parse(get(path_).body);
  EXPECT_EQ(table["stage"], "ik");
  EXPECT_EQ(table["final"], false);
  EXPECT_EQ(table["provenance"], std::string(64, 'd'));
  EXPECT_EQ(table["settings"], json::parse(R"({"ik":{}})"));
  EXPECT_EQ(table["columns"][0]["side"], "right");
  EXPECT_EQ(table["columns"][1]["side"], "left");
  EXPECT_EQ(table["columns"][2]["side"], nullptr);
}

TEST_F(ResultRoutes, AxisAndAnglesAreAsked) {
  const json plain = json::parse(get(path_).body);
  EXPECT_EQ(stub_.record.calls.back(), std::string("find table ") + kJobId + " kinematics time");
  EXPECT_EQ(plain["columns"][0]["unit"], "rad");
  const json degrees = json::parse(get(path_, {{"axis", "cycle"}, {"angles", "deg"}}).body);
  EXPECT_EQ(stub_.record.calls.back(), std::string("find table ") + kJobId + " kinematics cycle");
  EXPECT_EQ(degrees["axis"]["unit"], "percent");
  EXPECT_EQ(degrees["columns"][0]["unit"], "deg");
  EXPECT_NEAR(degrees["columns"][0]["values"][0].get<double>(), 28.64788975654116, 1e-13);
  EXPECT_EQ(degrees["columns"][1]["values"], json({0.25, 1.0}));
  EXPECT_EQ(get(path_, {{"format", "sto"}, {"angles", "deg"}}).body, "kinematics deg");
  EXPECT_EQ(get(path_, {{"format", "sto"}, {"axis", "cycle"}}).body,
            "kinematics, column time in percent of the gait cycle rad");
}

TEST_F(ResultRoutes, EveryRepresentationHasATagOfItsOwn) {
  std::set<std::string> tags;
  for (const char* format : {"json", "csv", "sto"}) {
    for (const char* axis : {"time", "cycle"}) {
      for (const char* angles : {"rad", "deg"}) {
        tags.insert(get(path_, {{"format", format}, {"axis", axis}, {"angles", angles}})
                        .headers.at("ETag"));
      }
    }
  }
  stub_.record.is_final = false;
  tags.insert(get(path_).headers.at("ETag"));
  tags.insert(get(job_ + "/results/moments").headers.at("ETag"));
  tags.insert(get(job_ + "/results/quality").headers.at("ETag"));
  EXPECT_EQ(tags.size(), 15U);
  for (const std::string& tag : tags) {
    EXPECT_EQ(tag.substr(0, 65), "\"" + std::string(64, 'd')) << tag;
  }
}

TEST_F(ResultRoutes, QualityComesInAllFormats) {
  const std::string path = job_ + "/results/quality";
  EXPECT_EQ(get(path).body, R"({"tracking":{"rra":{"max_deg":1.5}}})");
  EXPECT_EQ(get(path, {{"format", "csv"}}).body, "quantity,value\ntracking.rra.max_deg,1.5\n");
  EXPECT_EQ(get(path, {{"format", "sto"}}).body, "quality rad");
}

TEST_F(ResultRoutes, UnknownResultsFormatsAndUnitsAreRefusedBeforeAnyoneIsAsked) {
  const auto codeOf = [&](const std::string& name, std::map<std::string, std::string> query) {
    return errorOf([&] { get(job_ + "/results/" + name, query); }).code();
  };
  EXPECT_EQ(codeOf("momentz", {}), ErrorCode::kResultNotFound);
  EXPECT_EQ(codeOf("moments", {{"format", "xml"}}), ErrorCode::kRequestNotAcceptable);
  EXPECT_EQ(codeOf("moments", {{"axis", "percent"}}), ErrorCode::kRequestField);
  EXPECT_EQ(codeOf("moments", {{"angles", "degrees"}}), ErrorCode::kRequestField);
  EXPECT_TRUE(stub_.record.calls.empty());
  EXPECT_NE(errorOf([&] { get(job_ + "/results/momentz"); }).message().find("mean 'moments'?"),
            std::string::npos);
}

TEST_F(ResultRoutes, ListSaysFormsOfEachResult) {
  const json list = json::parse(get(job_ + "/results").body)["items"];
  EXPECT_EQ(list[0], json::parse(R"({"name": "kinematics", "stage": "ik",
      "axes": ["time", "cycle"], "formats": ["json", "csv", "sto"]})"));
  EXPECT_EQ(list[1]["axes"], json::array({"time"}));
}

TEST_F(ResultRoutes, FilesAndArchiveAreDownloads) {
  const HttpReply file = get(job_ + "/files/ik.mot");
  EXPECT_EQ(readAll(*file.source, 100), "bytes");
  EXPECT_EQ(file.headers.at("Content-Disposition"), "attachment; filename=\"ik.mot\"");
  const HttpReply archive = get(job_ + "/results.zip");
  EXPECT_EQ(archive.content_type, "application/zip");
  EXPECT_EQ(archive.headers.at("Content-Disposition"),
            std::string("attachment; filename=\"") + kJobId + ".zip\"");
}

TEST_F(ResultRoutes, StudyIsOneJobPerTrialAndSettings) {
  const HttpReply reply = post("/v1/studies",
                               R"({"name": "spring", "trials": ["tri_1", "tri_2"],
               "settings": ["default", {"ik": {}}], "label": "x"})",
                               {{"idempotency-key", "k"}});
  EXPECT_EQ(reply.status, 202);
  EXPECT_EQ(reply.headers.at("Location"), study_);
  const StudyRequest& study = stub_.record.study;
  ASSERT_EQ(study.jobs.size(), 4U);
  EXPECT_EQ(study.submission_key, "k");
  EXPECT_EQ(study.jobs[1].trial_id, "tri_1");
  EXPECT_EQ(study.jobs[1].settings_json, R"({"ik":{}})");
  EXPECT_EQ(study.jobs[2].trial_id, "tri_2");
  EXPECT_EQ(study.jobs[2].settings_name, "default");
  EXPECT_EQ(study.jobs[2].settings_json, "");
  EXPECT_EQ(study.jobs[3].label, "x");
}

TEST_F(ResultRoutes, StudyTableHasOneRowPerJob) {
  const json rows = json::parse(get(study_ + "/results").body)["items"];
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0]["quality"]["ik"]["rms_mm"], 4.5);
  EXPECT_EQ(rows[1]["quality"], nullptr);
  // A spreadsheet would run what begins with an equals sign.
  EXPECT_EQ(get(study_ + "/results", {{"format", "csv"}}).body,
            "job,trial,subject,label,settings,state,verdict,ik.rms_mm\n" + std::string(kJobId) +
                "," + kTrialId + ",'=S07,,default,succeeded,pass,4.5\n" + kJobId + "," + kTrialId +
                ",,,default,queued,,\n");
}

TEST_F(ResultRoutes, EveryCallCarriesTheTenant) {
  HttpRequest request;
  request.identity.tenant = "lab_b";
  for (const std::string& path : {path_,
                                  job_,
                                  trial_,
                                  study_,
                                  study_ + "/results",
                                  job_ + "/files",
                                  job_ + "/results.zip",
                                  std::string("/v1/models/lab"),
                                  std::string("/v1/keys")}) {
    stub_.record.tenant.clear();
    call("GET", path, request);
    EXPECT_EQ(stub_.record.tenant, "lab_b") << path;
  }
}

}  // namespace
}  // namespace gaitmill::api

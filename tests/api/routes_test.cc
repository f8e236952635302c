// Every route against recording ports: what it asks for, and what it makes of the answer.

#include "api/routes.h"

#include <optional>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "tests/api/stub_ports.h"

namespace gaitmill::api {
namespace {

using nlohmann::json;

class RoutesTest : public ::testing::Test {
 protected:
  HttpReply call(const std::string& method, const std::string& path, HttpRequest request = {}) {
    const RouteMatch match = router_.find(method, path);
    request.captures = match.captures;
    return match.route->handle(request);
  }
  HttpReply get(const std::string& path, std::map<std::string, std::string> query = {}) {
    HttpRequest request;
    request.query = std::move(query);
    return call("GET", path, request);
  }
  // The error of an upload of these parts.
  Error uploadError(std::vector<BodyPart> parts) {
    HttpRequest request;
    request.parts = std::move(parts);
    try {
      call("POST", "/v1/trials", request);
    } catch (const Error& error) {
      return error;
    }
    return Error(ErrorCode::kInternal, "nothing was thrown");
  }

  StubPorts stub_;
  Router router_{makeRoutes(stub_.ports(), "1.2.3")};
  const std::string job_ = std::string("/v1/jobs/") + kJobId;
};

const BodyPart kSubject{"trial", "", R"({"mass_kg": 75.3, "height_m": 1.7})"};

TEST_F(RoutesTest, VersionIsThatOfTheBinary) {
  EXPECT_EQ(get("/v1/version").body, R"({"name":"gaitmill","version":"1.2.3"})");
}

TEST_F(RoutesTest, UploadHandsOverPartsUnderPlainNames) {
  HttpRequest request;
  request.parts = {{"markers", "C:\\lab\\..\\walk.trc", "bytes"},
                   {"grf", "../../etc/passwd", "forces"},
                   {"static", "", "still"},
                   kSubject};
  const HttpReply reply = call("POST", "/v1/trials", request);
  EXPECT_EQ(reply.status, 201);
  EXPECT_EQ(reply.headers.at("Location"), std::string("/v1/trials/") + kTrialId);
  const TrialUpload& upload = stub_.record.upload;
  EXPECT_EQ(upload.subject.mass, 75.3);
  EXPECT_EQ(upload.files.at("markers").name, "walk.trc");
  EXPECT_EQ(upload.files.at("markers").bytes, "bytes");
  EXPECT_EQ(upload.files.at("grf").name, "passwd");
  EXPECT_EQ(upload.files.at("static").name, "static");
}

TEST_F(RoutesTest, UploadRefusesUnknownDoubleAndMissingParts) {
  EXPECT_EQ(uploadError({{"markerz", "a", "b"}, kSubject}).where().field, "markerz");
  EXPECT_EQ(uploadError({{"grf", "a", "b"}, {"grf", "a", "b"}, kSubject}).where().field, "grf");
  EXPECT_EQ(uploadError({kSubject, kSubject}).where().field, "trial");
  EXPECT_EQ(uploadError({{"markers", "a", "b"}}).where().field, "trial");
  EXPECT_TRUE(stub_.record.calls.empty());
}

TEST_F(RoutesTest, SubmitTakesANameADocumentOrNothing) {
  HttpRequest request;
  request.body = R"({"trial": "tri_1", "settings": "paper_walk"})";
  EXPECT_EQ(call("POST", "/v1/jobs", request).status, 202);
  EXPECT_EQ(stub_.record.request.settings_name, "paper_walk");
  request.body = R"({"trial": "tri_1", "settings": {"cmc": {"window_s": 0.01}}})";
  call("POST", "/v1/jobs", request);
  EXPECT_EQ(stub_.record.request.settings_name, "");
  EXPECT_EQ(stub_.record.request.settings_json, R"({"cmc":{"window_s":0.01}})");
  request.body = R"({"trial": "tri_1"})";
  call("POST", "/v1/jobs", request);
  EXPECT_EQ(stub_.record.request.settings_name, "default");
}

TEST_F(RoutesTest, CancelAsksForThisJob) {
  EXPECT_EQ(call("POST", job_ + "/cancel").status, 202);
  EXPECT_EQ(stub_.record.calls.back(), std::string("cancel job ") + kJobId);
}

TEST_F(RoutesTest, ResultFormatFollowsParameterThenAccept) {
  const std::string path = job_ + "/results/kinematics";
  EXPECT_EQ(get(path).content_type, "application/json");
  EXPECT_EQ(get(path, {{"format", "csv"}}).content_type, "text/csv; charset=utf-8");
  EXPECT_EQ(get(path, {{"format", "sto"}}).body, "kinematics rad");
  HttpRequest request;
  request.accept = "application/vnd.opensim.sto, */*;q=0.1";
  EXPECT_EQ(call("GET", path, request).body, "kinematics rad");
  request.query["format"] = "csv";
  EXPECT_EQ(call("GET", path, request).headers.at("Vary"), "Accept");
  EXPECT_EQ(call("GET", path, request).content_type, "text/csv; charset=utf-8");
}

TEST_F(RoutesTest, AxisAndAnglesAreAsked) {
  const std::string path = job_ + "/results/kinematics";
  const json plain = json::parse(get(path).body);
  EXPECT_EQ(stub_.record.calls.back(), std::string("find table ") + kJobId + " kinematics time");
  EXPECT_EQ(plain["columns"][0]["unit"], "rad");
  const json degrees = json::parse(get(path, {{"axis", "cycle"}, {"angles", "deg"}}).body);
  EXPECT_EQ(stub_.record.calls.back(), std::string("find table ") + kJobId + " kinematics cycle");
  EXPECT_EQ(degrees["axis"]["unit"], "percent");
  EXPECT_EQ(degrees["columns"][0]["unit"], "deg");
  EXPECT_NEAR(degrees["columns"][0]["values"][0].get<double>(), 28.64788975654116, 1e-13);
  EXPECT_EQ(degrees["columns"][1]["values"], json({0.25, 1.0}));
  EXPECT_EQ(get(path, {{"format", "sto"}, {"angles", "deg"}}).body, "kinematics deg");
  EXPECT_EQ(get(path, {{"format", "sto"}, {"axis", "cycle"}}).body,
            "kinematics, column time in percent of the gait cycle rad");
}

TEST_F(RoutesTest, QualityComesInAllFormats) {
  const std::string path = job_ + "/results/quality";
  EXPECT_EQ(get(path).body, R"({"tracking":{"rra":{"max_deg":1.5}}})");
  EXPECT_EQ(get(path, {{"format", "csv"}}).body, "quantity,value\ntracking.rra.max_deg,1.5\n");
  EXPECT_EQ(get(path, {{"format", "sto"}}).body, "quality rad");
}

TEST_F(RoutesTest, UnknownResultsFormatsAndUnitsAreRefusedBeforeAnyoneIsAsked) {
  const auto codeOf = [&](const std::string& name, std::map<std::string, std::string> query) {
    try {
      get(job_ + "/results/" + name, std::move(query));
      return ErrorCode::kInternal;
    } catch (const Error& error) {
      return error.code();
    }
  };
  EXPECT_EQ(codeOf("momentz", {}), ErrorCode::kResultNotFound);
  EXPECT_EQ(codeOf("moments", {{"format", "xml"}}), ErrorCode::kRequestNotAcceptable);
  EXPECT_EQ(codeOf("moments", {{"axis", "percent"}}), ErrorCode::kRequestField);
  EXPECT_EQ(codeOf("moments", {{"angles", "degrees"}}), ErrorCode::kRequestField);
  EXPECT_TRUE(stub_.record.calls.empty());
}

TEST_F(RoutesTest, FileCarriesItsNameAndHash) {
  const HttpReply reply = get(job_ + "/files/ik.mot");
  EXPECT_EQ(reply.body, "bytes");
  EXPECT_EQ(reply.headers.at("Content-Disposition"), "attachment; filename=\"ik.mot\"");
  EXPECT_EQ(reply.headers.at("ETag"), "\"" + std::string(64, 'b') + "\"");
}

}  // namespace
}  // namespace gaitmill::api

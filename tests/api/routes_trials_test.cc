// What the routes of trials ask for, and what they make of the answer.

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/api/route_fixture.h"

namespace gaitmill::api {
namespace {

using nlohmann::json;

BodyPart makePart(const std::string& name, const std::string& file_name, const std::string& bytes) {
  return {name, file_name, makeByteSource(bytes)};
}

BodyPart subject() {
  return makePart("trial", "", R"({"mass_kg": 75.3, "height_m": 1.7, "subject": "S07"})");
}

class TrialRoutes : public RouteFixture {
 protected:
  HttpReply upload(std::vector<BodyPart> parts, std::map<std::string, std::string> query = {}) {
    HttpRequest request;
    request.headers["content-type"] = "multipart/form-data; boundary=x";
    request.query = std::move(query);
    request.parts = std::move(parts);
    return call("POST", "/v1/trials", request);
  }
  std::string faultyField(const std::vector<BodyPart>& parts) {
    return errorOf([&] { upload(parts); }).where().field;
  }
};

TEST_F(TrialRoutes, UploadHandsOverPartsUnderPlainNames) {
  const HttpReply reply = upload({makePart("markers", "C:\\lab\\..\\walk.trc", "bytes"),
                                  makePart("grf", "../../etc/passwd", "forces"),
                                  makePart("static", "", "still"),
                                  subject()});
  EXPECT_EQ(reply.status, 201);
  EXPECT_EQ(reply.headers.at("Location"), trial_);
  const TrialUpload& got = stub_.record.upload;
  EXPECT_EQ(got.subject.mass, 75.3);
  EXPECT_EQ(got.subject.subject, "S07");
  EXPECT_EQ(got.files.at("markers").name, "walk.trc");
  EXPECT_EQ(readAll(*got.files.at("markers").bytes, 100), "bytes");
  EXPECT_EQ(got.files.at("grf").name, "passwd");
  EXPECT_EQ(got.files.at("static").name, "static");
}

TEST_F(TrialRoutes, UploadRefusesUnknownDoubleAndMissingParts) {
  EXPECT_EQ(faultyField({makePart("markerz", "a", "b"), subject()}), "markerz");
  EXPECT_EQ(faultyField({makePart("grf", "a", "b"), makePart("grf", "a", "b"), subject()}), "grf");
  EXPECT_EQ(faultyField({subject(), subject()}), "trial");
  EXPECT_EQ(faultyField({makePart("markers", "a", "b")}), "trial");
  EXPECT_TRUE(stub_.record.calls.empty());
}

TEST_F(TrialRoutes, DryRunStoresNothing) {
  const HttpReply reply = upload({subject()}, {{"validate", "only"}});
  EXPECT_EQ(reply.status, 200);
  EXPECT_EQ(reply.headers.count("Location"), 0U);
  EXPECT_EQ(json::parse(reply.body)["id"], nullptr);
  EXPECT_EQ(stub_.record.calls, (std::vector<std::string>{"validate trial"}));
  EXPECT_EQ(errorOf([&] { upload({subject()}, {{"validate", "yes"}}); }).where().field, "validate");
  EXPECT_EQ(errorOf([&] {
              upload({subject()}, {{"validat", "only"}});
            }).message(),
            "there is no parameter of this name; did you mean 'validate'?");
}

TEST_F(TrialRoutes, TrialWithoutFilesIsOneJsonDocument) {
  EXPECT_EQ(post("/v1/trials", R"({"mass_kg": 70, "height_m": 1.8})").status, 201);
  EXPECT_EQ(stub_.record.upload.subject.height, 1.8);
  EXPECT_TRUE(stub_.record.upload.files.empty());
}

TEST_F(TrialRoutes, PutFileTakesItsNameFromQueryOrHeader) {
  HttpRequest request;
  request.body = makeByteSource("bytes");
  EXPECT_EQ(call("PUT", trial_ + "/files/markers", request).status, 200);
  EXPECT_EQ(stub_.record.file.second.name, "markers");
  request.headers["content-disposition"] = "attachment; filename=\"lab/walk.trc\"";
  call("PUT", trial_ + "/files/markers", request);
  EXPECT_EQ(stub_.record.file.second.name, "walk.trc");
  request.query["name"] = "run.trc";
  call("PUT", trial_ + "/files/markers", request);
  EXPECT_EQ(stub_.record.file.first, "markers");
  EXPECT_EQ(stub_.record.file.second.name, "run.trc");
  EXPECT_EQ(errorOf([&] { call("PUT", trial_ + "/files/pictures", request); }).code(),
            ErrorCode::kRequestNotFound);
}

TEST_F(TrialRoutes, FilesAreHeldAgainstTheirDigest) {
  HttpRequest request;
  request.body = makeByteSource("hello");
  request.headers["content-digest"] = "sha-256=:LPJNul+wow4m6DsqxbninhsWHlwfp0JecwQzYpOLmCQ=:";
  EXPECT_EQ(call("PUT", trial_ + "/files/markers", request).status, 200);
  stub_.record.calls.clear();
  request.body = makeByteSource("hellO");
  EXPECT_EQ(errorOf([&] { call("PUT", trial_ + "/files/markers", request); }).code(),
            ErrorCode::kRequestDigest);
  EXPECT_TRUE(stub_.record.calls.empty());
}

TEST_F(TrialRoutes, FileComesBackAsADownload) {
  const HttpReply reply = get(trial_ + "/files/markers");
  EXPECT_EQ(readAll(*reply.source, 100), "bytes");
  EXPECT_EQ(reply.headers.at("Content-Disposition"), "attachment; filename=\"walk.trc\"");
  EXPECT_EQ(reply.headers.at("ETag"), "\"" + std::string(64, 'b') + "\"");
}

TEST_F(TrialRoutes, DeletionAnswersWithNothing) {
  const HttpReply reply = call("DELETE", trial_);
  EXPECT_EQ(reply.status, 204);
  EXPECT_EQ(reply.body, "");
  EXPECT_EQ(stub_.record.calls.back(), std::string("remove trial ") + kTrialId);
}

TEST_F(TrialRoutes, WhatIsNoIdIsNobodysTrial) {
  for (const char* id :
       {"job_01hf3v6k9e2m8xw7p0q4t5r6s1", "tri_1", "tri_01HF3V6K9E2M8XW7P0Q4T5R6S1"}) {
    EXPECT_EQ(errorOf([&] { get(std::string("/v1/trials/") + id); }).code(),
              ErrorCode::kTrialNotFound)
        << id;
  }
  EXPECT_TRUE(stub_.record.calls.empty());
}

TEST_F(TrialRoutes, ShowsWhatWasUnderstood) {
  const HttpReply reply = get(trial_);
  const json trial = json::parse(reply.body);
  EXPECT_EQ(trial["files"][0]["marker_sets"][0],
            json::parse(R"({"marker_set": "lab_a", "found": ["RASI"], "missing": ["RTOE"]})"));
  EXPECT_EQ(trial["files"][1]["contacts"][0]["foot"], "right");
  EXPECT_EQ(trial["files"][1]["contacts"][1]["foot"], nullptr);
  EXPECT_EQ(trial["events"][1], json::parse(R"({"event": "toe_off", "foot": "right", "time_s": 1.1,
                            "source": "forces", "marker_difference_s": null})"));
  EXPECT_EQ(reply.headers.at("ETag"), get(trial_).headers.at("ETag"));
}

}  // namespace
}  // namespace gaitmill::api

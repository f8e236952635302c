#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/api/route_fixture.h"

namespace gaitmill::api {
namespace {

using nlohmann::json;

constexpr const char* kOtherJobId = "job_01hf3v6k9e2m8xw7p0q4t5r6s2";

class FigureRoutesTest : public RouteFixture {
 protected:
  HttpReply accept(const std::string& path, const std::string& media_type) {
    HttpRequest request;
    request.headers["accept"] = media_type;
    return call("GET", path, request);
  }
  const std::string both_ = std::string(kJobId) + "," + kOtherJobId;
};

TEST_F(FigureRoutesTest, ListSaysWhereEachFigureIs) {
  const json list = json::parse(get(job_ + "/plots").body);
  ASSERT_EQ(list["items"].size(), 1U);
  EXPECT_EQ(list["items"][0]["name"], "angles");
  EXPECT_EQ(list["items"][0]["url"], job_ + "/plots/angles");
  EXPECT_TRUE(list["next_cursor"].is_null());
}

TEST_F(FigureRoutesTest, FigureComesAsVegaLiteUnderBothMediaTypes) {
  const HttpReply plain = get(job_ + "/plots/angles");
  EXPECT_EQ(plain.content_type, "application/json");
  EXPECT_NE(json::parse(plain.body)["$schema"].get<std::string>().find("vega-lite/v5"),
            std::string::npos);
  const HttpReply named = accept(job_ + "/plots/angles", "application/vnd.vegalite.v5+json");
  EXPECT_EQ(named.content_type, "application/vnd.vegalite.v5+json");
  EXPECT_EQ(named.body, plain.body);
  EXPECT_NE(named.headers.at("ETag"), plain.headers.at("ETag"));
  EXPECT_EQ(named.headers.at("Vary"), "Accept");
}

TEST_F(FigureRoutesTest, FigureComesAsDataAndAsSvg) {
  const json data = json::parse(get(job_ + "/plots/angles", {{"data", "only"}}).body);
  EXPECT_EQ(data["panels"][0]["series"][0]["y"], (json{5.0, nullptr, 60.0}));
  const HttpReply svg = get(job_ + "/plots/angles", {{"format", "svg"}});
  EXPECT_EQ(svg.content_type, "image/svg+xml");
  EXPECT_EQ(svg.body.find("<svg"), 0U);
  EXPECT_EQ(accept(job_ + "/plots/angles", "image/*").content_type, "image/svg+xml");
}

TEST_F(FigureRoutesTest, FormsThatThereAreNotAreRefused) {
  const auto code = [this](const std::map<std::string, std::string>& query) {
    return errorOf([&] { get(job_ + "/plots/angles", query); }).code();
  };
  EXPECT_EQ(code({{"format", "pdf"}}), ErrorCode::kRequestNotAcceptable);
  EXPECT_EQ(code({{"data", "all"}}), ErrorCode::kRequestField);
  EXPECT_EQ(code({{"data", "only"}, {"format", "svg"}}), ErrorCode::kRequestNotAcceptable);
  EXPECT_EQ(code({{"from", "1"}}), ErrorCode::kRequestField);
}

TEST_F(FigureRoutesTest, WhatTheClientHasIsNotMadeAgain) {
  const std::string tag = get(job_ + "/plots/angles").headers.at("ETag");
  stub_.record.calls.clear();
  HttpRequest request;
  request.headers["if-none-match"] = tag;
  const HttpReply reply = call("GET", job_ + "/plots/angles", request);
  EXPECT_EQ(reply.headers.at("ETag"), tag);
  EXPECT_EQ(stub_.record.calls, (std::vector<std::string>{std::string("tag figures ") + kJobId}));
  // A tag of another form is not this one.
  HttpRequest data;
  data.headers["if-none-match"] = tag;
  data.query["data"] = "only";
  EXPECT_FALSE(call("GET", job_ + "/plots/angles", data).body.empty());
}

TEST_F(FigureRoutesTest, ComparisonNamesTheJobsAndItsPlots) {
  const json comparison = json::parse(get("/v1/compare", {{"jobs", both_}}).body);
  EXPECT_EQ(comparison["ids"], (json{kJobId, kOtherJobId}));
  EXPECT_EQ(comparison["jobs"], (json{"first", "second"}));
  EXPECT_EQ(comparison["tables"][0]["columns"][0]["differences"][0]["largest"], -1.5);
  EXPECT_TRUE(comparison["quality"][0]["values"][1].is_null());
  EXPECT_EQ(comparison["plots"][0]["url"], "/v1/compare/plots/angles?jobs=" + both_);
  EXPECT_TRUE(comparison["tables"].is_array());
  EXPECT_EQ(stub_.record.calls.back(), std::string("compare ") + kJobId + " and " + kOtherJobId);
  EXPECT_TRUE(
      json::parse(get("/v1/compare/plots/angles", {{"jobs", both_}}).body).contains("$schema"));
}

class BadJobList : public FigureRoutesTest, public ::testing::WithParamInterface<const char*> {};
TEST_P(BadJobList, IsRefusedByName) {
  for (const char* path : {"/v1/compare", "/v1/compare/plots/angles"}) {
    const Error error = errorOf([&] { get(path, {{"jobs", GetParam()}}); });
    EXPECT_EQ(error.code(), ErrorCode::kRequestField) << path;
    EXPECT_EQ(error.where().field, "jobs");
  }
}
INSTANTIATE_TEST_SUITE_P(
    All,
    BadJobList,
    ::testing::Values("",
                      "job_01hf3v6k9e2m8xw7p0q4t5r6s1",
                      "job_01hf3v6k9e2m8xw7p0q4t5r6s1,job_01hf3v6k9e2m8xw7p0q4t5r6s1",
                      "job_01hf3v6k9e2m8xw7p0q4t5r6s1,,job_01hf3v6k9e2m8xw7p0q4t5r6s2",
                      "a,b",
                      "job_01hf3v6k9e2m8xw7p0q4t5r6s1,job_01hf3v6k9e2m8xw7p0q4t5r6s2,"
                      "job_01hf3v6k9e2m8xw7p0q4t5r6s3,job_01hf3v6k9e2m8xw7p0q4t5r6s4,"
                      "job_01hf3v6k9e2m8xw7p0q4t5r6s5,job_01hf3v6k9e2m8xw7p0q4t5r6s6,"
                      "job_01hf3v6k9e2m8xw7p0q4t5r6s7,job_01hf3v6k9e2m8xw7p0q4t5r6s8,"
                      "job_01hf3v6k9e2m8xw7p0q4t5r6s9"));

TEST_F(FigureRoutesTest, ValidationsAreListedAndMadeWithTheirSeed) {
  const std::string folder = std::string("/v1/models/") + kModelId + "/validation";
  EXPECT_EQ(json::parse(get(folder).body)["items"][0]["url"], folder + "/angles");
  const std::string first = get(folder + "/angles").headers.at("ETag");
  EXPECT_EQ(stub_.record.calls.back(), std::string("validate ") + kModelId + " angles 1");
  const HttpReply other = get(folder + "/angles", {{"seed", "18446744073709551615"}});
  EXPECT_NE(other.headers.at("ETag"), first);
  EXPECT_EQ(stub_.record.calls.back(),
            std::string("validate ") + kModelId + " angles 18446744073709551615");
  for (const char* seed : {"", "-1", "1.5", "18446744073709551616", "one"}) {
    const Error error = errorOf([&] { get(folder + "/angles", {{"seed", seed}}); });
    EXPECT_EQ(error.code(), ErrorCode::kRequestField) << seed;
    EXPECT_EQ(error.where().field, "seed");
  }
}

}  // namespace
}  // namespace gaitmill::api

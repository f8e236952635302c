#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/api/route_fixture.h"

namespace gaitmill::api {
namespace {

using nlohmann::json;

class ImageRoutesTest : public RouteFixture {};

TEST_F(ImageRoutesTest, ImageComesWithItsTypeAndTag) {
  const HttpReply pose = get(job_ + "/images/pose.png", {{"percent", "50"}, {"view", "frontal"}});
  EXPECT_EQ(pose.content_type, "image/png");
  EXPECT_EQ(pose.headers.at("ETag"), "\"tag\"");
  EXPECT_EQ(readAll(*pose.source, 100), "pixels");
  EXPECT_EQ(stub_.record.image.percent, 50.0);
  EXPECT_EQ(stub_.record.image.view, "frontal");
  EXPECT_EQ(get(job_ + "/images/animation.webp").content_type, "image/webp");
  EXPECT_EQ(stub_.record.image.kind, ImageKind::kAnimation);
  EXPECT_EQ(get(job_ + "/images/strip.png", {{"poses", "4"}}).content_type, "image/png");
  EXPECT_EQ(stub_.record.image.poses, 4);
}

TEST_F(ImageRoutesTest, ParametersOfAnotherKindOfImageAreRefused) {
  const Error error = errorOf([&] { get(job_ + "/images/pose.png", {{"poses", "4"}}); });
  EXPECT_EQ(error.code(), ErrorCode::kRequestField);
  EXPECT_EQ(error.where().field, "poses");
  const Error misspelt = errorOf([&] { get(job_ + "/images/pose.png", {{"colour", "force"}}); });
  EXPECT_NE(misspelt.message().find("'color'"), std::string::npos) << misspelt.message();
}

TEST_F(ImageRoutesTest, WhatTheClientHasIsNotDrawnAgain) {
  HttpRequest request;
  request.headers["if-none-match"] = "\"tag\"";
  const HttpReply reply = call("GET", job_ + "/images/pose.png", request);
  EXPECT_EQ(reply.headers.at("ETag"), "\"tag\"");
  EXPECT_EQ(stub_.record.calls, (std::vector<std::string>{std::string("tag image ") + kJobId}));
}

TEST_F(ImageRoutesTest, ReportIsAPageInWhichNothingRuns) {
  const HttpReply report = get(job_ + "/report.html");
  EXPECT_EQ(report.content_type, "text/html; charset=utf-8");
  EXPECT_NE(report.headers.at("Content-Security-Policy").find("default-src 'none'"),
            std::string::npos);
  EXPECT_EQ(report.headers.at("Content-Security-Policy").find("script-src"), std::string::npos);
  EXPECT_NE(report.body.find("report"), std::string::npos);
}

TEST_F(ImageRoutesTest, VerdictIsJson) {
  EXPECT_EQ(json::parse(get(job_ + "/quality").body)["verdict"], "pass");
}

TEST_F(ImageRoutesTest, IdsThatCannotBeAreNotLookedUp) {
  for (const char* path : {"/images/pose.png", "/images/strip.png", "/report.html", "/quality"}) {
    EXPECT_EQ(errorOf([&] { get(std::string("/v1/jobs/job_1") + path); }).code(),
              ErrorCode::kJobNotFound)
        << path;
  }
  EXPECT_TRUE(stub_.record.calls.empty());
}

}  // namespace
}  // namespace gaitmill::api

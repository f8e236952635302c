#include "api/errors.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gaitmill::api {
namespace {

TEST(HttpStatus, EveryCodeIsAnErrorStatus) {
  for (const ErrorCode code : allErrorCodes()) {
    EXPECT_GE(httpStatus(code), 400) << codeName(code);
    EXPECT_LT(httpStatus(code), 600) << codeName(code);
  }
}

TEST(ReplyError, SaysCodeMessagePlaceAndContext) {
  Error error(ErrorCode::kTrcColumnCount, "row has 124 values", {"walk1.trc", 214, 1, ""});
  error.addContext("reading markers");
  const HttpReply reply = replyError(error);
  EXPECT_EQ(reply.status, 422);
  EXPECT_EQ(reply.content_type, "application/json");
  EXPECT_EQ(nlohmann::json::parse(reply.body), nlohmann::json::parse(R"({"error": {
      "code": "trc.column_count", "message": "row has 124 values",
      "where": {"file": "walk1.trc", "line": 214, "column": 1},
      "context": ["reading markers"]}})"));
}

TEST(ReplyError, KeepsOurOwnFaultsToTheLog) {
  const HttpReply reply = replyError(Error(ErrorCode::kStorage, "no such table: secrets"));
  EXPECT_EQ(reply.status, 500);
  EXPECT_EQ(reply.body.find("secrets"), std::string::npos);
}

TEST(ReplyError, SurvivesBytesThatAreNotUtf8) {
  const HttpReply reply = replyError(Error(ErrorCode::kTrcHeader, "found '\xff\xfe'"));
  EXPECT_EQ(nlohmann::json::parse(reply.body)["error"]["code"], "trc.header");
}

}  // namespace
}  // namespace gaitmill::api

#include "api/errors.h"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gaitmill::api {
namespace {

using nlohmann::json;

TEST(HttpStatus, EveryCodeIsAnErrorStatus) {
  for (const ErrorCode code : allErrorCodes()) {
    EXPECT_GE(httpStatus(code), 400) << codeName(code);
    EXPECT_LT(httpStatus(code), 600) << codeName(code);
  }
}

// Thrown without a place, so that the problem has to find one itself.
TEST(RenderProblem, EveryCodeHasCodeWhereAndFix) {
  for (const ErrorCode code : allErrorCodes()) {
    const json problem = json::parse(renderProblem(Error(code, "a sentence"), "req_1"));
    EXPECT_EQ(problem["code"], codeName(code));
    EXPECT_EQ(problem["type"], "/problems/" + std::string(codeName(code)));
    EXPECT_GE(problem["where"].size(), 1U) << codeName(code);
    EXPECT_GE(problem["fix"].get<std::string>().size(), 20U) << codeName(code);
    EXPECT_EQ(problem["fix"].get<std::string>().back(), '.') << codeName(code);
    EXPECT_FALSE(problem["title"].get<std::string>().empty()) << codeName(code);
    EXPECT_FALSE(problem["detail"].get<std::string>().empty()) << codeName(code);
    EXPECT_EQ(problem["status"], httpStatus(code));
    EXPECT_EQ(problem["instance"], "urn:gaitmill:request:req_1");
  }
}

TEST(RenderProblem, SaysPlaceAndContext) {
  Where where{"walk1.trc", 214, 1, "RASI"};
  where.stage = "ik";
  where.time = 1.25;
  where.marker = "RASI";
  where.muscle = "soleus_r";
  where.coordinate = "knee_angle_r";
  Error error(ErrorCode::kTrcColumnCount, "row has 124 values", where);
  error.addContext("reading markers");
  EXPECT_EQ(json::parse(renderProblemObject(error)), json::parse(R"({
      "type": "/problems/trc.column_count", "title": "TRC column count", "status": 422,
      "detail": "row has 124 values", "code": "trc.column_count",
      "where": {"file": "walk1.trc", "line": 214, "column": 1, "field": "RASI", "stage": "ik",
                "time_s": 1.25, "marker": "RASI", "muscle": "soleus_r",
                "coordinate": "knee_angle_r"},
      "fix": "Give the row as many values as the header announces: frame, time and three per marker.",
      "context": ["reading markers"]})"));
}

TEST(RenderProblem, ListsWhatAModelHasThatCannotBeSimulated) {
  const Error error(ErrorCode::kModelUnsupported,
                    "2 parts of the model cannot be simulated:"
                    "\nline 12: WrapTorus 'hole': no rigid surface"
                    "\nline 30: Ligament 'acl': not known: at all\nand 3 more of these types",
                    {"knee.osim", 12, 5, "WrapTorus 'hole'"});
  EXPECT_EQ(json::parse(renderProblem(error, "req_1"))["unsupported"], json::parse(R"([
      {"line": 12, "element": "WrapTorus 'hole'", "reason": "no rigid surface"},
      {"line": 30, "element": "Ligament 'acl'", "reason": "not known: at all"}])"));
  EXPECT_FALSE(
      json::parse(renderProblem(Error(ErrorCode::kModelUnsupported, "a pair of shoes"), "req_1"))
          .contains("unsupported"));
}

TEST(RenderProblem, KeepsOurOwnFaultsToTheLog) {
  for (const ErrorCode code :
       {ErrorCode::kStorage, ErrorCode::kInternal, ErrorCode::kFileNotFound}) {
    Error error(code, "no such table: secrets", {"/var/lib/secrets.db", 3, 0, ""});
    error.addContext("reading secrets");
    const std::string problem = renderProblem(error, "req_1");
    EXPECT_EQ(problem.find("secrets"), std::string::npos) << problem;
  }
}

// The reason why a job was given up is for its owner.
TEST(RenderProblem, TellsWhatHappenedToAJob) {
  const json problem = json::parse(
      renderProblemObject(Error(ErrorCode::kJobMemory, "the solver asked for 3 GB", {})));
  EXPECT_EQ(problem["detail"], "the solver asked for 3 GB");
}

TEST(RenderProblem, SurvivesBytesThatAreNotUtf8) {
  const HttpReply reply = replyError(Error(ErrorCode::kTrcHeader, "found '\xff\xfe'"));
  EXPECT_EQ(json::parse(reply.body)["code"], "trc.header");
}

TEST(ReplyError, HasTheHeadersOfItsStatus) {
  const HttpReply reply = replyError(Error(ErrorCode::kTrcHeader, "a sentence"));
  EXPECT_EQ(reply.status, 422);
  EXPECT_EQ(reply.content_type, "application/problem+json");
  const auto headersOf = [](ErrorCode code) {
    return replyError(Error(code, "x")).headers;
  };
  EXPECT_EQ(headersOf(ErrorCode::kUnauthorized).count("WWW-Authenticate"), 1U);
  EXPECT_EQ(headersOf(ErrorCode::kForbidden).count("WWW-Authenticate"), 1U);
  for (const ErrorCode code : {ErrorCode::kRequestBusy,
                               ErrorCode::kQuotaExceeded,
                               ErrorCode::kStorageFull,
                               ErrorCode::kIdempotencyBusy}) {
    EXPECT_EQ(headersOf(code).count("Retry-After"), 1U) << codeName(code);
  }
}

TEST(RenderProblemType, ExplainsEveryCodeAndNoOther) {
  for (const ErrorCode code : allErrorCodes()) {
    const json type = json::parse(renderProblemType(std::string(codeName(code))));
    EXPECT_EQ(type["fix"], codeFix(code));
  }
  EXPECT_THROW(renderProblemType("trc"), Error);
}

}  // namespace
}  // namespace gaitmill::api

#include "api/idempotency.h"

#include <string>

#include <gtest/gtest.h>

#include "api/digest.h"
#include "tests/api/route_fixture.h"

namespace gaitmill::api {
namespace {

class IdempotencyTest : public RouteFixture {
 protected:
  HttpReply submit(const std::string& trial, const std::string& key = "k") {
    return post("/v1/jobs", "{\"trial\": \"" + trial + "\"}", {{"idempotency-key", key}});
  }
  std::size_t callCount() const { return stub_.record.calls.size(); }
};

TEST_F(IdempotencyTest, FirstAnswerIsRepeatedWithoutDoingItAgain) {
  const HttpReply first = submit("tri_1");
  const HttpReply second = submit("tri_1");
  EXPECT_EQ(callCount(), 1U);
  EXPECT_EQ(second.status, first.status);
  EXPECT_EQ(second.body, first.body);
  EXPECT_EQ(second.headers.at("Location"), first.headers.at("Location"));
  EXPECT_EQ(second.headers.at("Idempotency-Replayed"), "true");
  EXPECT_EQ(first.headers.count("Idempotency-Replayed"), 0U);
}

TEST_F(IdempotencyTest, ErrorsAreAnswersToo) {
  stub_.record.failure = Error(ErrorCode::kTrialNotFound, "no such trial");
  const HttpReply first = submit("tri_1");
  stub_.record.failure = std::nullopt;
  const HttpReply second = submit("tri_1");
  EXPECT_EQ(first.status, 404);
  EXPECT_EQ(second.status, 404);
  EXPECT_EQ(second.content_type, "application/problem+json");
  EXPECT_EQ(second.body, first.body);
}

TEST_F(IdempotencyTest, AnotherRequestUnderTheSameKeyIsRefused) {
  submit("tri_1");
  const Error error = errorOf([&] { submit("tri_2"); });
  EXPECT_EQ(error.code(), ErrorCode::kIdempotencyMismatch);
  EXPECT_EQ(callCount(), 1U);
}

TEST_F(IdempotencyTest, KeyIsTakenWhileTheFirstRequestIsAnswered) {
  HttpRequest request;
  request.headers["idempotency-key"] = "k";
  request.body = makeByteSource("");
  ErrorCode inner = ErrorCode::kInternal;
  const Handler handler = withIdempotency(stub_.idempotency, [&](HttpRequest&) {
    HttpRequest again = request;
    const Handler other =
        withIdempotency(stub_.idempotency, [](HttpRequest&) { return HttpReply{}; });
    inner = errorOf([&] { other(again); }).code();
    return HttpReply{};
  });
  handler(request);
  EXPECT_EQ(inner, ErrorCode::kIdempotencyBusy);
}

TEST_F(IdempotencyTest, WhatMaySucceedLaterIsNotKept) {
  for (const ErrorCode code : {ErrorCode::kInternal,
                               ErrorCode::kStorageFull,
                               ErrorCode::kRequestBusy,
                               ErrorCode::kQuotaExceeded}) {
    stub_.record.failure = Error(code, "not now");
    errorOf([&] { submit("tri_1"); });
    EXPECT_TRUE(stub_.idempotency.kept.empty()) << codeName(code);
    stub_.record.failure = std::nullopt;
  }
  EXPECT_EQ(submit("tri_1").status, 202);
}

TEST_F(IdempotencyTest, KeysOfTenantsAreTheirOwn) {
  submit("tri_1");
  HttpRequest request;
  request.identity.tenant = "lab_b";
  request.headers["idempotency-key"] = "k";
  request.body = makeByteSource(R"({"trial": "tri_2"})");
  EXPECT_EQ(call("POST", "/v1/jobs", request).status, 202);
  EXPECT_EQ(callCount(), 2U);
}

TEST_F(IdempotencyTest, WithoutAKeyEveryRequestCounts) {
  submit("tri_1", "");
  submit("tri_1", "");
  EXPECT_EQ(callCount(), 2U);
  EXPECT_TRUE(stub_.idempotency.kept.empty());
}

TEST_F(IdempotencyTest, KeysAreShortAndPrintable) {
  for (const std::string& key :
       {std::string(256, 'k'), std::string("a b"), std::string("\xc3\xa4")}) {
    EXPECT_EQ(errorOf([&] { submit("tri_1", key); }).where().field, "Idempotency-Key") << key;
  }
}

TEST_F(IdempotencyTest, WaitingSubmissionKeepsTheJobAsItWasSubmitted) {
  HttpRequest request;
  request.headers = {{"idempotency-key", "k"}, {"prefer", "wait=5"}};
  request.body = makeByteSource(R"({"trial": "tri_1"})");
  HttpRequest again = request;
  EXPECT_TRUE(ask("POST", "/v1/jobs", request).park.has_value());
  const HttpReply replayed = ask("POST", "/v1/jobs", again);
  EXPECT_FALSE(replayed.park.has_value());
  EXPECT_EQ(replayed.headers.at("Location"), job_);
}

HttpRequest makeRequest(const std::string& method,
                        const std::string& path,
                        const std::string& body) {
  HttpRequest request;
  request.method = method;
  request.path = path;
  request.body = makeByteSource(body);
  return request;
}

TEST(HashRequest, DiffersWithMethodPathQueryAndBody) {
  const std::string base = hashRequest(makeRequest("POST", "/a", "b"));
  EXPECT_EQ(base, hashRequest(makeRequest("POST", "/a", "b")));
  EXPECT_NE(base, hashRequest(makeRequest("PUT", "/a", "b")));
  EXPECT_NE(base, hashRequest(makeRequest("POST", "/ab", "")));
  EXPECT_NE(base, hashRequest(makeRequest("POST", "/a", "c")));
  HttpRequest query = makeRequest("POST", "/a", "b");
  query.query["x"] = "1";
  EXPECT_NE(base, hashRequest(query));
}

// curl draws a new boundary every time.
TEST(HashRequest, OfMultipartIsThatOfItsParts) {
  HttpRequest first = makeRequest("POST", "/a", "--x with this boundary");
  first.parts = {{"markers", "walk.trc", makeByteSource("bytes")}};
  HttpRequest second = makeRequest("POST", "/a", "--y with another");
  second.parts = {{"markers", "walk.trc", makeByteSource("bytes")}};
  EXPECT_EQ(hashRequest(first), hashRequest(second));
  second.parts[0].bytes = makeByteSource("bytez");
  EXPECT_NE(hashRequest(first), hashRequest(second));
}

}  // namespace
}  // namespace gaitmill::api

#include "api/digest.h"

#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace gaitmill::api {
namespace {

// NIST, FIPS 180-2 example: "abc".
constexpr const char* kAbc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

TEST(HashBytes, MeetsTheStandardsExample) {
  EXPECT_EQ(hashBytes(*makeByteSource("abc")), kAbc);
}

TEST(HashBytes, ReadsPieceByPiece) {
  const std::string large(3'000'000, 'a');
  const auto source = makeByteSource("x" + large + "x");
  EXPECT_EQ(hashBytes(*makeSlice(source, 1, large.size())), hashBytes(*makeByteSource(large)));
}

TEST(HashTexts, KnowsWhereOneTextEnds) {
  EXPECT_NE(hashTexts({"ab", "c"}), hashTexts({"a", "bc"}));
  EXPECT_NE(hashTexts({"abc"}), hashTexts({"abc", ""}));
}

HttpRequest makeRequest(const std::string& digest) {
  HttpRequest request;
  request.body = makeByteSource("abc");
  request.headers["content-digest"] = digest;
  return request;
}

constexpr const char* kSha256 = "sha-256=:ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0=:";
constexpr const char* kSha512 =
    "sha-512=:3a81oZNherrMQXNJriBBMRLm+k6JqX6iCp7u5ktV05ohkpkqJ0/BqDa6PCOj/"
    "uu9RU1EI2Q86A4qmslPpUyknw="
    "=:";

TEST(CheckContentDigest, TakesRightDigestsAndNone) {
  EXPECT_NO_THROW(checkContentDigest(makeRequest("")));
  EXPECT_NO_THROW(checkContentDigest(makeRequest(kSha256)));
  EXPECT_NO_THROW(checkContentDigest(makeRequest(kSha512)));
  EXPECT_NO_THROW(checkContentDigest(makeRequest(std::string("md5=:eA==:, ") + kSha256)));
}

TEST(CheckContentDigest, RefusesWrongAndUselessOnes) {
  for (const std::string& digest : {std::string("sha-256=:AAAA:"),
                                    std::string("sha-256=ungWv48Bz"),
                                    std::string("md5=:eA==:"),
                                    std::string("nonsense"),
                                    std::string(kSha256) + ", sha-512=:AAAA:"}) {
    try {
      checkContentDigest(makeRequest(digest));
      FAIL() << digest;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kRequestDigest) << digest;
      EXPECT_EQ(error.where().field, "Content-Digest");
    }
  }
}

}  // namespace
}  // namespace gaitmill::api

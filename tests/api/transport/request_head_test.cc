#include "api/request_head.h"

#include <random>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace gaitmill::api {
namespace {

RequestHead parse(const std::string& text) {
  return parseRequestHead(text, {});
}

TEST(RequestHead, IsTakenApart) {
  const RequestHead head = parse(
      "POST /v1/a%20b?x=1&y=%2F&x=2 HTTP/1.1\r\nHost: h\r\nX-A:  b c \r\nx-a: d\r\n"
      "Content-Length: 12\r\nConnection: Upgrade, CLOSE\r\n\r\n");
  EXPECT_EQ(head.method, "POST");
  EXPECT_EQ(head.path, "/v1/a b");
  EXPECT_EQ(head.query.at("x"), "1");
  EXPECT_EQ(head.query.at("y"), "/");
  EXPECT_EQ(head.header("x-a"), "b c, d");
  EXPECT_EQ(head.content_length, 12U);
  EXPECT_FALSE(head.keep_alive);
  EXPECT_EQ(head.header("nothing"), "");
}

// cpp-httplib decodes percent signs in header values, which changes them.
TEST(RequestHead, ValuesAreNotDecoded) {
  EXPECT_EQ(parse("GET / HTTP/1.1\r\nHost: h\r\nA: %0d%41+\r\n\r\n").header("a"), "%0d%41+");
}

TEST(RequestHead, EndIsFoundWhereverTheBytesAreCut) {
  const std::string head = "GET / HTTP/1.1\r\nHost: h\r\n\r\n";
  const std::string bytes = head + "rest\r\n\r\n";
  std::size_t scanned = 0;
  for (std::size_t size = 1; size < head.size(); ++size) {
    EXPECT_EQ(findHeadEnd(bytes.substr(0, size), scanned), std::string::npos);
    scanned = size;
  }
  EXPECT_EQ(findHeadEnd(bytes, scanned), head.size());
  EXPECT_EQ(findHeadEnd(bytes), head.size());
}

TEST(RequestHead, BareLineFeedsEndTheSearch) {
  EXPECT_EQ(findHeadEnd("GET / HTTP/1.1\nHost"), 15U);
  EXPECT_EQ(findHeadEnd("\n"), 1U);
}

TEST(RequestHead, MediaTypesAreComparable) {
  EXPECT_EQ(findMediaType("Application/JSON ; charset=utf-8"), "application/json");
  EXPECT_EQ(findMediaType(""), "");
}

TEST(RequestHead, DamagedHeadsNeverDoMoreThanThrow) {
  std::mt19937 random(7);
  const std::string good =
      "PUT /v1/a%20b?x=1&y=2 HTTP/1.1\r\nHost: h\r\nContent-Length: 12\r\nA: b\r\n\r\n";
  for (int round = 0; round < 50'000; ++round) {
    std::string bytes = good;
    for (int change = 0; change < 3; ++change) {
      bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
    }
    const std::size_t end = findHeadEnd(bytes);
    try {
      checkPartialHead(bytes, {});
      if (end != std::string::npos) {
        const RequestHead head = parse(bytes.substr(0, end));
        EXPECT_FALSE(head.method.empty());
        EXPECT_FALSE(head.path.empty());
      }
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kRequestMalformed);
    }
  }
}

}  // namespace
}  // namespace gaitmill::api

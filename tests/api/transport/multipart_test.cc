#include "api/multipart.h"

#include <random>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/api/transport/transport_server.h"

namespace gaitmill::api {
namespace {

std::vector<BodyPart> scan(const std::string& body, const std::string& boundary = "x") {
  return scanMultipart(makeByteSource(body), boundary, {});
}

std::string makePart(const std::string& disposition, const std::string& content) {
  return "--x\r\nContent-Disposition: " + disposition + "\r\n\r\n" + content + "\r\n";
}

ErrorCode codeOf(const std::string& body) {
  try {
    scan(body);
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::kInternal;
}

TEST(Multipart, BoundaryIsFoundInContentType) {
  EXPECT_EQ(findMultipartBoundary("multipart/form-data; boundary=abc"), "abc");
  EXPECT_EQ(findMultipartBoundary("multipart/form-data; charset=utf-8; Boundary=\"a b=c\""),
            "a b=c");
  EXPECT_EQ(findMultipartBoundary("multipart/form-data;boundary=abc;x=y"), "abc");
  EXPECT_THROW(findMultipartBoundary("multipart/form-data"), Error);
  EXPECT_THROW(findMultipartBoundary("multipart/form-data; boundary=\"a \""), Error);
}

TEST(Multipart, NamesAreReadAsBrowsersAndCurlWriteThem) {
  const auto nameOf = [](const std::string& disposition) {
    return scan(makePart(disposition, "") + "--x--").at(0);
  };
  EXPECT_EQ(nameOf("form-data; name=\"a\"; filename=\"walk 1.trc\"").file_name, "walk 1.trc");
  EXPECT_EQ(nameOf("form-data; name=a; filename=b.trc").file_name, "b.trc");
  EXPECT_EQ(nameOf("form-data; filename=\"a;name=b\"; name=\"c\"").name, "c");
  EXPECT_EQ(nameOf("form-data; name=\"a\"; filename=\"C:\\lab\\walk.trc\"").file_name,
            "C:\\lab\\walk.trc");
  EXPECT_EQ(nameOf("form-data; name=\"a\"; filename=\"say \\\"hi\\\"\"").file_name, "say \"hi\"");
  EXPECT_EQ(
      nameOf("form-data; name=\"a\"; filename=\"b\"; filename*=UTF-8''na%C3%AFve.trc").file_name,
      "na\xc3\xafve.trc");
}

TEST(Multipart, ContentIsTakenAsItIs) {
  const std::string content("\r\n--\r\n--y\r\n\0--x \r\n\r\n", 20);
  const auto parts = scan(makePart("form-data; name=a", content) + "--x--\r\nepilogue");
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(readAll(*parts[0].bytes, 100), content);
}

TEST(Multipart, LinesAroundBoundariesMayHaveBlanks) {
  EXPECT_EQ(scan("\r\n--x \t\r\nContent-Disposition: form-data; name=a\r\n\r\nb\r\n--x--  ").size(),
            1U);
}

// Boundaries and headers that lie across the edges of the scanner's windows.
TEST(Multipart, PartsAreFoundAtEveryPlaceOfAWindow) {
  constexpr std::size_t kWindow = 256U << 10U;
  for (std::size_t size = kWindow - 80; size < kWindow + 10; ++size) {
    const std::string first = makePattern(0, size);
    const std::string body =
        makePart("form-data; name=a", first) + makePart("form-data; name=b", "second") + "--x--";
    const auto parts = scan(body);
    ASSERT_EQ(parts.size(), 2U) << size;
    EXPECT_TRUE(readAll(*parts[0].bytes, size) == first);
    EXPECT_EQ(readAll(*parts[1].bytes, 10), "second");
  }
}

// A source that counts what is read from it, made of what looks like boundaries.
class BaitSource : public ByteSource {
 public:
  explicit BaitSource(std::string bytes) : bytes_(std::move(bytes)) {}
  std::uint64_t size() const override { return bytes_.size(); }
  std::string read(std::uint64_t offset, std::size_t size) const override {
    std::string piece = bytes_.substr(static_cast<std::size_t>(offset), size);
    read_bytes += piece.size();
    return piece;
  }
  mutable std::uint64_t read_bytes = 0;

 private:
  std::string bytes_;
};

TEST(Multipart, BaitDoesNotMakeTheScanReadTwice) {
  std::string body = makePart("form-data; name=a", "");
  while (body.size() < 4'000'000) {
    body += "\r\n--\r\n\r\n-";
  }
  const auto bait = std::make_shared<BaitSource>(body);
  EXPECT_THROW(scanMultipart(bait, "x", {}), Error);
  EXPECT_LT(bait->read_bytes, 2 * body.size());
}

TEST(Multipart, CutBodiesAreRefusedWhereverTheyAreCut) {
  const std::string body =
      makePart("form-data; name=\"a\"", "one") + makePart("form-data; name=\"b\"", "two") + "--x--";
  EXPECT_EQ(scan(body).size(), 2U);
  for (std::size_t size = 0; size < body.size(); ++size) {
    EXPECT_EQ(codeOf(body.substr(0, size)), ErrorCode::kRequestMalformed) << size;
  }
}

TEST(Multipart, DamagedBodiesNeverDoMoreThanThrow) {
  std::mt19937 random(7);
  const std::string good = makePart("form-data; name=\"a\"; filename=\"f\"", "one") +
                           makePart("form-data; name=b", "") + "--x--\r\n";
  for (int round = 0; round < 20'000; ++round) {
    std::string body = good;
    for (int change = 0; change < 3; ++change) {
      body[random() % body.size()] = "\r\n-x\";= \0a"[random() % 10];
    }
    try {
      for (const BodyPart& part : scan(body)) {
        EXPECT_LE(part.bytes->size(), body.size());
      }
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kRequestMalformed);
    }
  }
}

}  // namespace
}  // namespace gaitmill::api

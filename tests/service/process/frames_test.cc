#include "service/process/frames.h"

#include <random>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace gaitmill {
namespace {

TEST(Frames, ComeBackWhateverPiecesTheyTravelIn) {
  const std::string all_bytes("\0\xff\n", 3);
  const std::vector<Frame> sent = {{1, {}}, {2, {""}}, {255, {all_bytes, std::string(1000, 'x')}}};
  std::string wire;
  for (const Frame& frame : sent) {
    wire += encodeFrame(frame);
  }
  for (std::size_t piece : {1U, 3U, 7U, 4096U}) {
    FrameReader reader;
    std::vector<Frame> received;
    for (std::size_t i = 0; i < wire.size(); i += piece) {
      reader.append(wire.substr(i, piece));
      while (auto frame = reader.next()) {
        received.push_back(*frame);
      }
    }
    ASSERT_EQ(received.size(), sent.size());
    for (std::size_t i = 0; i < sent.size(); ++i) {
      EXPECT_EQ(received[i].kind, sent[i].kind);
      EXPECT_EQ(received[i].fields, sent[i].fields);
    }
  }
}

// Any bytes give frames, nothing yet, or the one error: never another exception, never much memory.
TEST(Frames, HostileBytesAreRefused) {
  std::mt19937 random(7);
  int refused = 0;
  for (int round = 0; round < 2000; ++round) {
    std::string bytes = encodeFrame({3, {"some", "fields", std::string(40, 'y')}});
    for (int i = 0; i < 3; ++i) {
      bytes[random() % bytes.size()] = static_cast<char>(random());
    }
    FrameReader reader;
    reader.append(bytes);
    try {
      while (reader.next()) {
      }
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kJobCrashed);
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);
}

TEST(Frames, AreNotLongerThanTheirLimit) {
  EXPECT_THROW(encodeFrame({1, {std::string(kMaxFrameBytes, 'x')}}), Error);
}

}  // namespace
}  // namespace gaitmill

#include "core/render/encoders.h"

#include <webp/demux.h>

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/core/render/decoded_image.h"

namespace gaitmill {
namespace {

Image makeGradient(int width, int height, int shift) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.bytes[image.at(x, y)] = static_cast<std::uint8_t>(3 * x + shift);
      image.bytes[image.at(x, y) + 1] = static_cast<std::uint8_t>(5 * y);
      image.bytes[image.at(x, y) + 2] = static_cast<std::uint8_t>(x + y);
    }
  }
  return image;
}

TEST(Png, KeepsEveryPixel) {
  const Image image = makeGradient(37, 23, 0);
  EXPECT_EQ(decodePng(encodePng(image)).bytes, image.bytes);
}

struct Frames {
  int width = 0;
  int height = 0;
  int loops = -1;
  std::vector<int> ends;  // [ms]
  std::vector<Rgb> middles;
};

Frames decodeWebp(const std::string& bytes) {
  const WebPData data{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
  WebPAnimDecoderOptions options;
  check(WebPAnimDecoderOptionsInit(&options) != 0, "libwebp");
  WebPAnimDecoder* decoder = WebPAnimDecoderNew(&data, &options);
  check(decoder != nullptr, "not an animated WebP");
  WebPAnimInfo info;
  check(WebPAnimDecoderGetInfo(decoder, &info) != 0, "no information");
  Frames frames;
  frames.width = static_cast<int>(info.canvas_width);
  frames.height = static_cast<int>(info.canvas_height);
  frames.loops = static_cast<int>(info.loop_count);
  std::uint8_t* pixels = nullptr;
  int end = 0;
  while (WebPAnimDecoderGetNext(decoder, &pixels, &end) != 0) {
    const std::size_t middle =
        4 * (info.canvas_width * (info.canvas_height / 2) + info.canvas_width / 2);
    frames.ends.push_back(end);
    frames.middles.push_back({pixels[middle], pixels[middle + 1], pixels[middle + 2]});
  }
  WebPAnimDecoderDelete(decoder);
  return frames;
}

TEST(Webp, FramesFollowEachOtherInTime) {
  WebpAnimation animation(64, 48, 100.0 / 3);
  for (int shift : {0, 40, 80}) animation.addFrame(makeGradient(64, 48, shift));
  const Frames frames = decodeWebp(animation.finish());
  EXPECT_EQ(frames.width, 64);
  EXPECT_EQ(frames.height, 48);
  EXPECT_EQ(frames.loops, 0);  // for ever
  EXPECT_EQ(frames.ends, (std::vector<int>{33, 67, 100}));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(frames.middles[i][0], 96 + 40 * static_cast<int>(i), 16);  // lossy
  }
}

}  // namespace
}  // namespace gaitmill

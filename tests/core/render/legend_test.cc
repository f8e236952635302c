#include "core/render/legend.h"

#include <gtest/gtest.h>

#include "core/render/picture_limits.h"

namespace gaitmill {
namespace {

LegendContent makeFullContent() {
  LegendContent content;
  content.instant = {"1.234 s", "56 % of gait cycle"};
  content.scale = &getColorScale(MuscleColor::kForce);
  content.forces = content.measured_markers = content.model_markers = true;
  return content;
}

bool contains(const Frame& outer, const Frame& inner) {
  return inner.left >= outer.left && inner.top >= outer.top && inner.right <= outer.right &&
         inner.bottom <= outer.bottom;
}

// Sizes at which the issue promises a readable picture, and the shapes around them.
TEST(Legend, LeavesTheBodyARoomOfItsOwn) {
  const int sizes[][2] = {
      {1280, 720}, {640, 360}, {400, 225}, {400, 400}, {400, 700}, {4096, 4096}};
  for (const auto& size : sizes) {
    const Layout layout = makeLayout(size[0], size[1], makeFullContent(), false);
    const Frame image{0, 0, static_cast<double>(size[0]), static_cast<double>(size[1])};
    EXPECT_TRUE(contains(image, layout.body)) << size[0] << " x " << size[1];
    EXPECT_TRUE(contains(image, layout.legend)) << size[0] << " x " << size[1];
    EXPECT_TRUE(layout.body.left >= layout.legend.right || layout.body.bottom <= layout.legend.top);
    EXPECT_GT(layout.body.bottom - layout.body.top, 0.55 * size[1]);
    EXPECT_GT(layout.body.right - layout.body.left, 0.3 * size[0]);
    EXPECT_GE(layout.cap_height, 6.5);  // [px] smaller capitals cannot be read
  }
}

// Whatever can be asked for must give a frame that a camera can work with.
TEST(Legend, EveryPermittedSizeHasRoomForTheBody) {
  for (const int width : {kMinimumSide, 17, 60, 200, 1000, kMaximumSide}) {
    for (const int height : {kMinimumSide, 17, 60, 200, 1000, kMaximumSide}) {
      for (const bool strip : {false, true}) {
        const Layout layout = makeLayout(width, height, makeFullContent(), strip);
        EXPECT_GT(layout.body.right, layout.body.left) << width << " x " << height;
        EXPECT_GT(layout.body.bottom, layout.body.top) << width << " x " << height;
      }
    }
  }
}

TEST(Legend, WithoutContentTheBodyHasAllTheRoom) {
  const Layout layout = makeLayout(640, 360, {}, false);
  EXPECT_LT(layout.body.left, 30);
  EXPECT_GT(layout.body.right, 610);
}

TEST(Legend, StaysInsideItsFrame) {
  Image image(640, 360);
  const LegendContent content = makeFullContent();
  const Layout layout = makeLayout(image.width, image.height, content, false);
  drawLegend(content, layout, 0.05, image);
  int inside = 0, outside = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.bytes[image.at(x, y)] == 0 && image.bytes[image.at(x, y) + 2] == 0) continue;
      const bool in = x >= layout.legend.left - 2 && x <= layout.legend.right + 2 &&
                      y >= layout.legend.top - 2 && y <= layout.legend.bottom + 2;
      ++(in ? inside : outside);
    }
  }
  EXPECT_GT(inside, 1000);
  EXPECT_EQ(outside, 0);
}

}  // namespace
}  // namespace gaitmill

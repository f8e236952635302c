#include "core/render/canvas.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr Ink kWhite{{255, 255, 255}, 1};

// Sum of a black image's red, as a number of fully white pixels.
double countInk(const Image& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.bytes.size(); i += 3) sum += image.bytes[i];
  return sum / 255;
}

TEST(Canvas, DiscAndRectangleCoverTheirAreas) {
  Image disc(60, 60), rectangle(60, 60);
  Canvas(disc).fillDisc({30.3, 29.6}, 20, kWhite);
  Canvas(rectangle).fillRectangle(3.25, 4.5, 40.75, 20.25, kWhite);
  EXPECT_NEAR(countInk(disc), kPi * 400, tol(0.01 * kPi * 400));
  EXPECT_NEAR(countInk(rectangle), 37.5 * 15.75, tol(0.005 * 37.5 * 15.75));
}

TEST(Canvas, TriangleCoversItsAreaWhicheverWayItTurns) {
  Image one(60, 60), other(60, 60);
  Canvas(one).fillTriangle({5, 5}, {55, 10}, {20, 50}, kWhite);
  Canvas(other).fillTriangle({5, 5}, {20, 50}, {55, 10}, kWhite);
  EXPECT_NEAR(countInk(one), 0.5 * (50 * 45 - 5 * 15), tol(15));  // edges' share of a pixel
  EXPECT_EQ(one.bytes, other.bytes);
}

TEST(Canvas, CrossingStrokesDoNotAddUp) {
  Image image(40, 40);
  const std::vector<Stroke> cross = {{{5, 20.5F}, {35, 20.5F}}, {{20.5F, 5}, {20.5F, 35}}};
  Canvas(image).drawStrokes(cross, 4, {{255, 255, 255}, 0.5});
  EXPECT_EQ(image.bytes[image.at(20, 20)], image.bytes[image.at(10, 20)]);
  EXPECT_EQ(image.bytes[image.at(20, 20)], 128);
}

TEST(Canvas, WhatLiesOutsideIsCutOff) {
  Image image(16, 16);
  Canvas canvas(image);
  canvas.fillDisc({-100, 4}, 20, kWhite);
  canvas.fillRectangle(50, 50, 90, 90, kWhite);
  canvas.drawText("far away", {300, -40}, 10, TextAnchor::kRight, kWhite);
  EXPECT_EQ(countInk(image), 0);
  canvas.fillRectangle(-1e6, -1e6, 1e6, 1e6, kWhite);
  EXPECT_EQ(countInk(image), 256);
}

TEST(Canvas, TextStandsWhereItsAnchorSays) {
  for (const TextAnchor anchor : {TextAnchor::kLeft, TextAnchor::kMiddle, TextAnchor::kRight}) {
    Image image(200, 40);
    Canvas(image).drawText("Hm", {100, 30}, 12, anchor, kWhite);
    int left = 200, right = 0, top = 40, bottom = 0;
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 200; ++x) {
        if (image.bytes[image.at(x, y)] < 128) continue;
        left = std::min(left, x);
        right = std::max(right, x);
        top = std::min(top, y);
        bottom = std::max(bottom, y);
      }
    }
    const double width = measureText("Hm", 12);
    const double share = anchor == TextAnchor::kLeft ? 0 : anchor == TextAnchor::kMiddle ? 0.5 : 1;
    EXPECT_NEAR(left, 100 - share * width, tol(2));  // half a pen and a pixel
    EXPECT_NEAR(right, 100 + (1 - share) * width, tol(2));
    EXPECT_NEAR(bottom, 30, tol(2));
    EXPECT_NEAR(top, 30 - 12, tol(2));
  }
}

TEST(Font, HasEveryLetterDigitAndSignOfTheLabels) {
  const Glyph& missing = getGlyph('\x01');
  for (const char c : std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789"
                                  ".,:-+=/()[]%'*<>_!?#&")) {
    const Glyph& glyph = getGlyph(c);
    ASSERT_FALSE(glyph.strokes.empty()) << c;
    EXPECT_NE(&glyph, &missing);
    for (const Stroke& stroke : glyph.strokes) {
      ASSERT_GE(stroke.size(), 2U) << c;
      for (const Eigen::Vector2f& p : stroke) {
        EXPECT_GE(p.x(), -0.5F) << c;
        EXPECT_LE(p.x(), glyph.advance - 1.4F) << c;  // the pen of the next glyph has room
        EXPECT_GE(p.y(), -3.3F) << c;
        EXPECT_LE(p.y(), 11.2F) << c;
      }
    }
  }
}

TEST(Font, DigitsAreOneWide) {
  for (const char digit : std::string("0123567890")) {
    EXPECT_NEAR(getGlyph(digit).advance, getGlyph('0').advance, 0.3F) << digit;
  }
}

}  // namespace
}  // namespace gaitmill

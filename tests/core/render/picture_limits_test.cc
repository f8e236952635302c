#include "core/render/picture_limits.h"

#include <limits>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

template <class Action>
ErrorCode findError(Action&& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::kInternal;
}

TEST(PictureView, NamesAndAnglesAreDirections) {
  EXPECT_NEAR(parseView("sagittal").azimuth, 0, tol(1e-15));
  EXPECT_NEAR(parseView("frontal").azimuth, 0.5 * kPi, tol(1e-15));
  EXPECT_GT(parseView("oblique").elevation, 0);
  const View view = parseView("-120, 35.5");
  EXPECT_NEAR(view.azimuth, toRadians(-120), tol(1e-15));
  EXPECT_NEAR(view.elevation, toRadians(35.5), tol(1e-15));
}

TEST(PictureView, OtherTextIsRefused) {
  for (const char* text :
       {"", "top", "10", "10,", ",5", "10,91", "361,0", "nan,0", "0,inf", "1,2,3"}) {
    EXPECT_EQ(findError([&] { parseView(text); }), ErrorCode::kRequestField) << text;
  }
}

TEST(PictureLimits, SidesAreBounded) {
  PictureOptions options;
  EXPECT_NO_THROW(validateOptions(options));
  for (const int side : {-5, 0, 15, 4097, std::numeric_limits<int>::max()}) {
    options = {};
    options.width = side;
    EXPECT_EQ(findError([&] { validateOptions(options); }), ErrorCode::kImageSize) << side;
    options = {};
    options.height = side;
    EXPECT_EQ(findError([&] { validateOptions(options); }), ErrorCode::kImageSize) << side;
  }
  options = {};
  options.width = 16;
  options.height = 4096;
  EXPECT_NO_THROW(validateOptions(options));
}

TEST(PictureLimits, ViewsMustBeNumbers) {
  PictureOptions options;
  options.view.azimuth = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(findError([&] { validateOptions(options); }), ErrorCode::kRequestField);
  options.view = {0, 2};
  EXPECT_EQ(findError([&] { validateOptions(options); }), ErrorCode::kRequestField);
}

TEST(PictureLimits, StripsAreBounded) {
  PictureOptions options;
  options.width = 200;
  options.height = 400;
  EXPECT_NO_THROW(validateStrip(0, 1, 24, options));
  for (const int count : {-1, 0, 25}) {
    EXPECT_EQ(findError([&] { validateStrip(0, 1, count, options); }), ErrorCode::kImageSize);
  }
  options.width = options.height = 4096;
  EXPECT_EQ(findError([&] { validateStrip(0, 1, 3, options); }), ErrorCode::kImageSize);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  options.width = options.height = 100;
  EXPECT_EQ(findError([&] { validateStrip(nan, 1, 3, options); }), ErrorCode::kRequestField);
}

TEST(PictureLimits, FramesFollowFromTimeRateAndSlowness) {
  PictureOptions options;
  options.width = 320;
  options.height = 180;
  EXPECT_EQ(countFrames(0.2, 1.2, 25, 2, options), 50);
  EXPECT_EQ(countFrames(0.2, 0.201, 25, 1, options), 1);
  EXPECT_EQ(findError([&] { countFrames(0, 100, 25, 2, options); }), ErrorCode::kImageSize);
  EXPECT_EQ(findError([&] { countFrames(1, 1, 25, 2, options); }), ErrorCode::kRequestField);
  EXPECT_EQ(findError([&] { countFrames(0, 1, 0, 2, options); }), ErrorCode::kRequestField);
  EXPECT_EQ(findError([&] { countFrames(0, 1, 25, -1, options); }), ErrorCode::kRequestField);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(findError([&] { countFrames(0, 1, nan, 1, options); }), ErrorCode::kRequestField);
  options.width = options.height = 4096;
  EXPECT_EQ(findError([&] { countFrames(0, 1, 25, 2, options); }), ErrorCode::kImageSize);
}

}  // namespace
}  // namespace gaitmill

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/osim_reader.h"
#include "core/io/osim_writer.h"
#include "core/render/camera.h"
#include "core/render/color_scale.h"
#include "core/render/legend.h"
#include "core/render/scene.h"
#include "core/render/subject.h"
#include "tests/core/render/decoded_image.h"
#include "tests/support/shared_data.h"
#include "tests/support/simple_models.h"
#include "tests/support/stride_picture.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

// Without a legend a picture's layout depends on nothing but its size.
PictureOptions makeOptions(int width, int height) {
  PictureOptions options;
  options.width = width;
  options.height = height;
  options.legend = false;
  return options;
}

// The camera that a picture without a legend is seen by.
Camera findCamera(const PictureData& data, const PictureOptions& options, Subject& subject) {
  subject.setPose(data.kinematics, 0);
  const Layout layout = makeLayout(options.width, options.height, {}, false);
  std::vector<Eigen::Vector3f> outline;
  collectOutline(subject, subject.findFollowPoint(), outline);
  const Framing framing = fitFraming(outline, options.view, layout.body);
  return makeCamera(options.view, framing, layout.body, subject.findFollowPoint());
}

bool isRed(const Rgb& color) {
  return color[0] > 110 && color[0] > 2 * color[1] && color[0] > 2 * color[2];
}
bool isGreen(const Rgb& color) {
  return color[1] > 1.5 * color[0] && color[1] > color[2];
}

// Whether a pixel within `reach` of a place is of a kind.
template <class Kind>
bool isNear(const Image& image, const Eigen::Vector3d& place, int reach, Kind&& kind) {
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const int px = static_cast<int>(place.x()) + x, py = static_cast<int>(place.y()) + y;
      if (px < 0 || py < 0 || px >= image.width || py >= image.height) continue;
      if (kind(pixelOf(image, px, py))) return true;
    }
  }
  return false;
}

class PaintedStride : public ::testing::Test {
 protected:
  PaintedStride() { activateSoleus(subject.model().spec(), data); }
  Image paint(const PictureOptions& options) {
    return decodePng(painter.paintPose(data, 0, options).bytes);
  }
  PictureData data = makeStridePicture();
  Subject subject{data.model_osim, ""};
  Painter painter;
};

TEST_F(PaintedStride, ActiveMuscleIsRedWhereItsPathIs) {
  PictureOptions options = makeOptions(640, 360);
  options.bones = options.forces = options.markers = false;
  options.view = {0.8 * kPi, 0};  // from behind, where nothing hides the calf
  const Image image = paint(options);
  const Camera camera = findCamera(data, options, subject);
  std::vector<PathVertex> path;
  subject.tracePath(MuscleIndex(subject.model().spec().findMuscle("soleus_r")), path);
  const Eigen::Vector3d belly = path.front().p_G + 0.3 * (path.back().p_G - path.front().p_G);
  const Eigen::Vector3d place = camera.project(belly);
  EXPECT_TRUE(isNear(image, place, 4, isRed));
  int stray = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double away = std::hypot(x - place.x(), y - place.y());
      if (isRed(pixelOf(image, x, y)) && away > 60) ++stray;
    }
  }
  EXPECT_EQ(stray, 0);
}

TEST_F(PaintedStride, ForceStandsOnItsCenterOfPressureAndPointsUp) {
  PictureOptions options = makeOptions(640, 360);
  options.bones = options.muscles = options.markers = false;
  const Image image = paint(options);
  const Camera camera = findCamera(data, options, subject);
  const Eigen::Vector3d foot(0.68, 0, 0.09), force(-90, 700, 20);
  const Eigen::Vector3d tip = camera.project(foot + 0.97 * kArrowLengthPerForce * force);
  EXPECT_TRUE(isNear(image, camera.project(foot), 3, isGreen));
  EXPECT_TRUE(isNear(image, tip, 2, isGreen));
  EXPECT_LT(tip.y(), camera.project(foot).y() - 40);
  int below = 0;
  for (int y = static_cast<int>(camera.project(foot).y()) + 5; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) below += isGreen(pixelOf(image, x, y)) ? 1 : 0;
  }
  EXPECT_EQ(below, 0);
}

TEST_F(PaintedStride, MarkersAreWhereTheCameraSaysTheyAre) {
  PictureOptions options = makeOptions(640, 360);
  options.bones = options.muscles = options.forces = false;
  options.view = {0.6, 0.2};
  const Image image = paint(options);
  const Camera camera = findCamera(data, options, subject);
  const std::size_t count = subject.model().spec().markers.size();
  ASSERT_GT(count, 20U);
  for (std::size_t m = 0; m < count; ++m) {
    const Eigen::Vector3d place = camera.project(subject.findMarker(static_cast<int>(m)));
    const auto pink = [](const Rgb& c) {
      return c[0] > 1.3 * c[1] && c[2] > 1.05 * c[1];
    };
    EXPECT_TRUE(isNear(image, place, 1, pink)) << subject.model().spec().markers[m].name;
  }
}

// Silhouette of a body without floor: what differs from the picture of nothing.
std::vector<bool> findBody(const Image& image, const Image& empty) {
  std::vector<bool> body;
  for (std::size_t i = 0; i < image.bytes.size(); i += 3) {
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      most = std::max(most, std::abs(image.bytes[i + c] - empty.bytes[i + c]));
    }
    body.push_back(most > 40);
  }
  return body;
}

TEST_F(PaintedStride, NoPixelOfTheBodyTouchesTheEdge) {
  for (const View view : {View{0, 0}, View{0.5 * kPi, 0}, View{2.4, 0.5}, View{1, -0.4}}) {
    PictureOptions options = makeOptions(320, 180);
    options.forces = options.ground = false;
    options.view = view;
    const Image image = paint(options);
    options.bones = options.muscles = options.markers = false;
    const std::vector<bool> body = findBody(image, paint(options));
    EXPECT_GT(std::count(body.begin(), body.end(), true), 1000);
    for (int y = 0; y < 180; ++y) {
      for (int x = 0; x < 320; ++x) {
        const bool edge = x == 0 || y == 0 || x == 319 || y == 179;
        if (edge) {
          EXPECT_FALSE(body[static_cast<std::size_t>(320 * y + x)]) << x << ' ' << y;
        }
      }
    }
  }
}

TEST_F(PaintedStride, SymmetricPoseLooksTheSameFromBothSides) {
  data.kinematics =
      makeConstantTable({{"pelvis_ty", 0.95}, {"elbow_flex_r", 1.0}, {"elbow_flex_l", 1.0}});
  PictureOptions options = makeOptions(320, 180);
  options.forces = options.ground = options.markers = false;
  PictureOptions nothing = options;
  nothing.bones = nothing.muscles = false;
  const Image empty = paint(nothing);
  const std::vector<bool> right = findBody(paint(options), empty);
  options.view.azimuth = kPi;
  const std::vector<bool> left = findBody(paint(options), empty);
  std::size_t differing = 0, body = 0;
  for (std::size_t y = 0; y < 180; ++y) {
    for (std::size_t x = 0; x < 320; ++x) {
      body += right[320 * y + x] ? 1U : 0U;
      differing += right[320 * y + x] != left[320 * y + 319 - x] ? 1U : 0U;
    }
  }
  // The light comes from the upper left in both, so that some pixels at the rim differ.
  EXPECT_LT(static_cast<double>(differing), 0.06 * static_cast<double>(body));
}

TEST_F(PaintedStride, TimesOutsideTheMotionShowItsEnds) {
  PictureOptions options = makeOptions(160, 120);
  data.kinematics.values(1, *data.kinematics.findColumn("knee_angle_r")) = 1.2;
  const auto at = [&](double time) {
    return painter.paintPose(data, time, options).bytes;
  };
  EXPECT_EQ(at(-5), at(0));
  EXPECT_EQ(at(9), at(1));
  EXPECT_NE(at(0), at(1));
}

TEST_F(PaintedStride, SamePictureTwiceIsTheSameFile) {
  const PictureOptions options = makeOptions(200, 120);
  const std::string first = painter.paintPose(data, 0, options).bytes;
  EXPECT_EQ(painter.paintPose(data, 0, options).bytes, first);
  Painter other;
  EXPECT_EQ(other.paintPose(data, 0, options).bytes, first);
}

// Tiles are an inner matter: what is larger than one shows the same picture.
TEST_F(PaintedStride, LargePictureShowsWhatTheSmallOneShows) {
  PictureOptions options = makeOptions(1600, 1000);
  options.markers = false;
  const Image large = paint(options);
  options.width = 400;
  options.height = 250;
  const Image small = paint(options);
  Image reduced(400, 250);
  for (int y = 0; y < 250; ++y) {
    for (int x = 0; x < 400; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        int sum = 0;
        for (int k = 0; k < 16; ++k) sum += large.bytes[large.at(4 * x + k % 4, 4 * y + k / 4) + c];
        reduced.bytes[reduced.at(x, y) + c] = static_cast<std::uint8_t>(sum / 16);
      }
    }
  }
  const Difference difference = compareImages(reduced, small);
  EXPECT_LT(difference.mean, 1.2);
  EXPECT_LT(difference.share, 0.03);  // tendons are thicker where pixels are large
}

TEST_F(PaintedStride, StripShowsItsPosesOnOneLine) {
  PictureOptions options = makeOptions(120, 240);
  options.legend = true;
  const Picture strip = painter.paintStrip(data, 0, 1, 5, options);
  EXPECT_EQ(strip.content_type, "image/png");
  const Image image = decodePng(strip.bytes);
  ASSERT_EQ(image.width, 600);
  ASSERT_EQ(image.height, 240);
  // The motion stands still, so all poses are equal down to the labels.
  for (int pose = 1; pose < 5; ++pose) {
    for (int y = 0; y < 170; ++y) {
      for (int x = 0; x < 120; ++x) {
        ASSERT_EQ(pixelOf(image, 120 * pose + x, y), pixelOf(image, x, y)) << pose;
      }
    }
  }
}

TEST_F(PaintedStride, NeighboursOfAStripMeetWithoutASeam) {
  PictureOptions options = makeOptions(240, 240);
  options.forces = options.markers = false;
  const Image image = decodePng(painter.paintStrip(data, 0, 1, 3, options).bytes);
  for (int y = 0; y < 240; ++y) {
    const Rgb a = pixelOf(image, 239, y), b = pixelOf(image, 240, y);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_LE(std::abs(a[c] - b[c]), 3) << y;
  }
}

TEST_F(PaintedStride, AnimationHasItsFrames) {
  const Picture animation = painter.paintAnimation(data, 0, 0.4, 10, 2, makeOptions(96, 64));
  EXPECT_EQ(animation.content_type, "image/webp");
  ASSERT_GT(animation.bytes.size(), 200U);
  EXPECT_EQ(animation.bytes.substr(0, 4), "RIFF");
  EXPECT_EQ(animation.bytes.substr(8, 4), "WEBP");
}

TEST_F(PaintedStride, AHundredPicturesInARowDoNotLeak) {
  const PictureOptions options = makeOptions(320, 180);
  const auto paintSome = [&](int count) {
    for (int i = 0; i < count; ++i) painter.paintPose(data, 0.01 * i, options);
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;  // [bytes] in use
  };
  const std::size_t before = paintSome(10);
#if !defined(__SANITIZE_ADDRESS__)  // whose allocator tells nothing here, but finds leaks by itself
  ASSERT_GT(before, 0U);
#endif
  EXPECT_LE(paintSome(100), before + 200'000);  // 2 kB each; one of the buffers has 230 kB
}

TEST_F(PaintedStride, PaintersComeAndGoWithoutALeak) {
  const PictureOptions options = makeOptions(64, 64);
  const auto paintSome = [&](int count) {
    for (int i = 0; i < count; ++i) Painter().paintPose(data, 0, options);
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
  };
  const std::size_t before = paintSome(2);
  EXPECT_LE(paintSome(3), before + 6'000'000);  // a renderer's buffers alone are 29 MB
}

TEST_F(PaintedStride, GapsInTheDataLeaveGapsInThePicture) {
  data.muscle_values = {};
  data.ground_reactions = {};
  data.markers = makeConstantTable({{"nobody_x", 0}});
  PictureOptions options = makeOptions(160, 120);
  options.legend = true;
  for (const MuscleColor color :
       {MuscleColor::kNone, MuscleColor::kActivation, MuscleColor::kFiberLength}) {
    options.color = color;
    EXPECT_EQ(paint(options).width, 160);
  }
}

TEST_F(PaintedStride, MotionWithoutValuesIsRefused) {
  data.kinematics.values.setConstant(std::numeric_limits<double>::quiet_NaN());
  try {
    painter.paintPose(data, 0, makeOptions(64, 64));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInputCoordinates);
  }
  data = makeStridePicture();
  EXPECT_NO_THROW(painter.paintPose(data, 0, makeOptions(64, 64)));  // and does no lasting harm
}

TEST_F(PaintedStride, AbsurdRequestsAreRefused) {
  const auto codeOf = [&](double time, int width) {
    try {
      painter.paintPose(data, time, makeOptions(width, 64));
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::kInternal;
  };
  EXPECT_EQ(codeOf(0, 5000), ErrorCode::kImageSize);
  EXPECT_EQ(codeOf(std::numeric_limits<double>::infinity(), 64), ErrorCode::kRequestField);
}

TEST_F(PaintedStride, SmallestPictureIsAPicture) {
  PictureOptions options = makeOptions(16, 16);
  options.legend = true;
  EXPECT_EQ(paint(options).height, 16);
}

TEST(SimpleModel, WithoutMusclesAndMarkersIsShown) {
  PictureData data;
  data.model_osim = writeOsim(makePendulum(2, 0.5));
  data.kinematics = makeConstantTable({{"angle", 0.3}});
  PictureOptions options = makeOptions(120, 120);
  options.legend = true;
  EXPECT_EQ(decodePng(Painter().paintPose(data, 0, options).bytes).width, 120);
}

class OtherModels : public SharedDataTest {};

TEST_F(OtherModels, AreShownInTheirDefaultPoseWhereTheReaderTakesThem) {
  Painter painter;
  int shown = 0;
  for (const std::string& path : listFiles(shared("data/models"), ".osim")) {
    PictureData data;
    data.model_osim = readFile(path);
    try {
      Model(readOsim(data.model_osim, path));
    } catch (const Error&) {
      continue;  // what cannot be simulated is not shown either
    }
    const Image image = decodePng(painter.paintPose(data, 0, makeOptions(160, 160)).bytes);
    EXPECT_EQ(image.width, 160) << path;
    ++shown;
  }
  EXPECT_GE(shown, 1);  // the others have moving path points or inertias that no body has
}

// Against pictures of our own, looked at before they were stored. GAITMILL_EXPECTED=write replaces
// them: look at every one again.
class ExpectedPicture : public PaintedStride {
 protected:
  void compare(const std::string& name, const Picture& picture) {
    const std::string path = "tests/core/render/expected/" + name + ".png";
    const char* mode = std::getenv("GAITMILL_EXPECTED");
    if (mode != nullptr && std::string(mode) == "write") writeFile(path, picture.bytes);
    const Difference difference =
        compareImages(decodePng(picture.bytes), decodePng(readFile(path)));
    // Renderers round the blended floor one level apart, hence the mean; the share is what a muscle
    // of the wrong colour exceeds, see below.
    EXPECT_LT(difference.mean, tol(0.3)) << name;
    EXPECT_LT(difference.share, tol(kShare)) << name;
  }
  static constexpr double kShare = 0.0003;
};

TEST_F(ExpectedPicture, WouldShowAMuscleOfTheWrongColor) {
  PictureOptions options = makeOptions(400, 225);
  options.view.azimuth = 0.8 * kPi;
  const Image right = paint(options);
  data.muscle_values.values.setConstant(0.1);
  EXPECT_GT(compareImages(paint(options), right).share, kShare);
}

TEST_F(ExpectedPicture, Sagittal) {
  PictureOptions options = makeOptions(400, 225);
  options.legend = true;
  compare("sagittal", painter.paintPose(data, 0.25, options));
}

TEST_F(ExpectedPicture, ObliqueForceWithoutBones) {
  PictureOptions options = makeOptions(225, 320);
  options.legend = true;
  options.bones = options.markers = false;
  options.color = MuscleColor::kFiberLength;
  options.view = parseView("oblique");
  data.cycle = GaitCycle{0, 1};
  compare("oblique_fiber_length", painter.paintPose(data, 0.25, options));
}

TEST_F(ExpectedPicture, Strip) {
  data.kinematics.values(1, *data.kinematics.findColumn("hip_flexion_l")) = 0.5;
  PictureOptions options = makeOptions(120, 240);
  options.legend = true;
  options.markers = false;
  compare("strip", painter.paintStrip(data, 0, 1, 4, options));
}

}  // namespace
}  // namespace gaitmill

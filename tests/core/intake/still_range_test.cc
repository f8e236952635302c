#include "core/intake/still_range.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

/// Three markers at 100 Hz, which swing along x outside 2 to 3 s and rest inside.
MarkerTrajectories makeTrial(int frames, double amplitude) {
  MarkerTrajectories trial;
  trial.names = {"A", "B", "C"};
  trial.positions = RowMatrix::Zero(frames, 9);
  for (int frame = 0; frame < frames; ++frame) {
    const double time = 0.01 * frame;
    trial.time.push_back(time);
    const bool rests = time > 2 && time < 3;
    for (int m = 0; m < 3; ++m) {
      trial.positions(frame, 3 * m) = rests ? 0.0 : amplitude * std::sin(7 * time + m);
      trial.positions(frame, 3 * m + 1) = 1000.0;
    }
  }
  return trial;
}

TEST(StillRange, QuietRecordingIsTakenWhole) {
  const StillRange still = findStillRange(makeTrial(500, 0.003));
  EXPECT_EQ(still.frames, 500);
  EXPECT_EQ(still.range.start, 0.0);
  EXPECT_TRUE(still.warnings.empty());
}

TEST(StillRange, OfAMovingOneTheQuietestPart) {
  const StillRange still = findStillRange(makeTrial(500, 0.05));
  EXPECT_GT(still.range.start, 2.0);
  EXPECT_LT(still.range.end, 3.0);
  EXPECT_NEAR(still.sway, 0, tol(1e-9));
  EXPECT_NEAR(still.whole_sway, 0.05 / std::sqrt(2) * std::sqrt(0.8), tol(0.003));
  ASSERT_EQ(still.warnings.size(), 1U);
  EXPECT_NE(still.warnings[0].find("the subject moves"), std::string::npos);
}

TEST(StillRange, ShortOneAndGapsAreSaid) {
  MarkerTrajectories trial = makeTrial(5, 0);
  for (int frame = 0; frame < 2; ++frame) {
    trial.positions(frame, 3) = std::numeric_limits<double>::quiet_NaN();
  }
  const StillRange still = findStillRange(trial);
  EXPECT_EQ(still.frames, 5);
  ASSERT_EQ(still.warnings.size(), 2U);
  EXPECT_NE(still.warnings[0].find("short: 5 frames"), std::string::npos);
  EXPECT_NE(still.warnings[1].find("B (60 %)"), std::string::npos);
}

TEST(StillRange, NothingSeenIsRefused) {
  MarkerTrajectories trial = makeTrial(50, 0);
  trial.positions.setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW(findStillRange(trial), Error);
  EXPECT_THROW(findStillRange(MarkerTrajectories{}), Error);
}

}  // namespace
}  // namespace gaitmill

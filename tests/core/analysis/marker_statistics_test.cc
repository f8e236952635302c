#include "core/analysis/marker_statistics.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(MarkerStatistics, CountOnlyFramesInWhichTheMarkerIsSeen) {
  TimeSeries distances = makeTimeSeries("marker_errors", {"RASI", "LASI"}, {0.0, 0.1, 0.2, 0.3});
  distances.values << 0.03, kNan, 0.04, kNan, kNan, kNan, 0.0, kNan;
  const std::vector<MarkerStatistics> markers = calcMarkerStatistics(distances, {50, 1});
  const MarkerStatistics& seen = markers[0];
  EXPECT_EQ(seen.marker, "RASI");
  EXPECT_EQ(seen.weight, 50);
  EXPECT_NEAR(seen.mean, 0.07 / 3, tol(1e-15));
  EXPECT_NEAR(seen.rms, 0.05 / std::sqrt(3.0), tol(1e-15));
  EXPECT_EQ(seen.max, 0.04);
  EXPECT_EQ(seen.max_frame, 1);
  EXPECT_EQ(seen.max_time, 0.1);
  EXPECT_EQ(seen.visible_fraction, 0.75);
}

TEST(MarkerStatistics, AMarkerThatIsNeverSeenHasNoFigures) {
  TimeSeries distances = makeTimeSeries("marker_errors", {"LASI"}, {0.0, 0.1});
  const MarkerStatistics hidden = calcMarkerStatistics(distances, {1}).front();
  EXPECT_TRUE(std::isnan(hidden.mean));
  EXPECT_TRUE(std::isnan(hidden.rms));
  EXPECT_TRUE(std::isnan(hidden.max));
  EXPECT_EQ(hidden.max_frame, -1);
  EXPECT_EQ(hidden.visible_fraction, 0);
}

TEST(MarkerStatistics, WithoutFramesThereIsNothingToJudge) {
  try {
    calcMarkerStatistics(makeTimeSeries("marker_errors", {"LASI"}, {}), {1});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kTableNoRows);
  }
}

}  // namespace
}  // namespace gaitmill

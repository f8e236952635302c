#include "core/analysis/tracking_error.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

TEST(TrackingError, TakesTheLargestOverCoordinatesOfEachKind) {
  TimeSeries errors =
      makeTimeSeries("errors", {"pelvis_ty", "hip_flexion_r", "knee_angle_r"}, {0, 1});
  errors.values << 0.003, 0.01, -0.03,  //
      -0.004, 0.01, 0.0;
  const TrackingError result = calcTrackingError(errors);
  EXPECT_NEAR(result.max_cm, 0.4, tol(1e-15));
  EXPECT_NEAR(result.max_rms_cm, std::sqrt(12.5) * 0.1, tol(1e-15));
  EXPECT_NEAR(result.max_deg, toDegrees(0.03), tol(1e-15));
  EXPECT_NEAR(result.max_rms_centiradian, 100 * 0.03 / std::sqrt(2.0), tol(1e-14));
  EXPECT_NEAR(result.max_rms_deg, toDegrees(0.03 / std::sqrt(2.0)), tol(1e-14));
  EXPECT_EQ(result.worst_rotation, "knee_angle_r");
  EXPECT_EQ(result.worst_translation, "pelvis_ty");
}

TEST(TrackingError, UnitsDecideBeforeNames) {
  TimeSeries errors = makeTimeSeries("errors", {"slide", "pelvis_tx"}, {0});
  errors.units = {"m", "rad"};
  errors.values << 0.02, 0.1;
  const TrackingError result = calcTrackingError(errors);
  EXPECT_NEAR(result.max_cm, 2, tol(1e-15));
  EXPECT_NEAR(result.max_deg, toDegrees(0.1), tol(1e-14));
}

TEST(TrackingError, WithoutTranslationsTheirFiguresAreNaN) {
  TimeSeries errors = makeTimeSeries("errors", {"knee_angle_r"}, {0});
  errors.values << 0.1;
  EXPECT_TRUE(std::isnan(calcTrackingError(errors).max_cm));
  EXPECT_TRUE(std::isnan(calcTrackingError(errors).max_rms_cm));
}

TEST(TrackingError, EmptyTableIsRefused) {
  EXPECT_THROW(calcTrackingError(makeTimeSeries("errors", {"knee_angle_r"}, {})), Error);
}

TEST(Difference, UsesCommonColumnsAndTheOverlapInTime) {
  TimeSeries reference = makeTimeSeries("reference", {"a", "b"}, {0, 2});
  reference.values << 0, 10,  //
      2, 30;
  TimeSeries actual = makeTimeSeries("actual", {"b", "c"}, {-1, 1, 2, 3});
  actual.values << 0, 0,  //
      15, 0,              //
      31, 0,              //
      0, 0;
  const TimeSeries difference = calcDifference(reference, actual);
  ASSERT_EQ(difference.labels, std::vector<std::string>{"b"});
  ASSERT_EQ(difference.time, (std::vector<double>{1, 2}));
  EXPECT_NEAR(difference.values(0, 0), 5, tol(1e-15));
  EXPECT_NEAR(difference.values(1, 0), -1, tol(1e-15));
}

}  // namespace
}  // namespace gaitmill

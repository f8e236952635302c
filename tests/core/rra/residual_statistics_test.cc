#include "core/rra/residual_statistics.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

TEST(ResidualStatistics, AverageIsTheTimeIntegralOverTheDuration) {
  TimeSeries table = makeResidualTable({0.0, 1.0, 3.0});
  table.values.setZero();
  table.values.col(1) << 2, 4, -6;
  const ResidualStatistics statistics = calcResidualStatistics(table);
  EXPECT_NEAR(statistics.average.force.y(), (3.0 - 2.0) / 3, tol(1e-15));
  EXPECT_EQ(statistics.peak.force.y(), 6);
  EXPECT_NEAR(statistics.rms.force.y(), std::sqrt(56.0 / 3), tol(1e-14));
  EXPECT_EQ(statistics.average.moment.norm(), 0);
  EXPECT_THROW(calcResidualStatistics(makeResidualTable({0.0})), Error);
}

TEST(TrackingStatistics, SeparatesRotationsFromTranslations) {
  TimeSeries errors = makeTimeSeries("e", {"knee", "pelvis_tx", "hip"}, {0.0, 1.0});
  errors.units = {"rad", "m", "rad"};
  errors.values << 0.01, -0.02, 0, -0.03, 0.01, 0.02;
  const TrackingStatistics statistics = calcTrackingStatistics(errors);
  EXPECT_NEAR(statistics.max_deg, toDegrees(0.03), tol(1e-13));
  EXPECT_NEAR(statistics.max_rms_deg, toDegrees(std::sqrt(5e-4)), tol(1e-13));
  EXPECT_NEAR(statistics.max_cm, 2, tol(1e-13));
  EXPECT_EQ(statistics.worst_rotation, "knee");
  EXPECT_EQ(statistics.worst_translation, "pelvis_tx");
}

}  // namespace
}  // namespace gaitmill

#include "core/analysis/actuator_statistics.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

TimeSeries makeForces() {
  TimeSeries forces = makeTimeSeries("forces", {"FX", "MZ"}, {0, 1});
  forces.values << 3, -1,  //
      -4, 7;
  return forces;
}

TEST(ActuatorStatistics, PeakAndRmsOfNamedColumns) {
  const auto statistics = calcActuatorStatistics(makeForces(), {"MZ", "FX"});
  ASSERT_EQ(statistics.size(), 2U);
  EXPECT_EQ(statistics[0].name, "MZ");
  EXPECT_EQ(statistics[0].peak, 7);
  EXPECT_NEAR(statistics[0].rms, 5, tol(1e-15));
  EXPECT_EQ(statistics[1].peak, 4);
  EXPECT_NEAR(statistics[1].rms, std::sqrt(12.5), tol(1e-15));
  EXPECT_EQ(findLargestPeak(statistics).name, "MZ");
}

TEST(ActuatorStatistics, UnknownActuatorIsAnError) {
  EXPECT_THROW(calcActuatorStatistics(makeForces(), {"FY"}), Error);
  EXPECT_THROW(findLargestPeak({}), Error);
}

}  // namespace
}  // namespace gaitmill

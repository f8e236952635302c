#include "core/sample/emg_envelopes.h"

#include <gtest/gtest.h>

#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

TEST(EmgEnvelopes, SoleusPeaksBeforeToeOffAndRestsInSwing) {
  const TimeSeries emg = makeEmgEnvelopes({0.42, 0.85}, 1.0);
  ASSERT_EQ(emg.columnCount(), 10);
  const int soleus = emg.getColumn("SOL");
  EXPECT_NEAR(emg.values(0, soleus), 1.0, tol(1e-15));
  EXPECT_EQ(emg.values(1, soleus), 0.02);
}

TEST(EmgEnvelopes, BurstsWrapAroundTheHeelStrike) {
  const TimeSeries emg = makeEmgEnvelopes({-0.05, 0.95, 1.95}, 1.0);
  const int tibialis = emg.getColumn("TA");
  EXPECT_GT(emg.values(1, tibialis), 0.2);
  EXPECT_NEAR(emg.values(0, tibialis), emg.values(1, tibialis), tol(1e-12));
  EXPECT_NEAR(emg.values(2, tibialis), emg.values(1, tibialis), tol(1e-12));
}

}  // namespace
}  // namespace gaitmill

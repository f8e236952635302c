#include "core/intake/laboratory.h"

#include <cstring>
#include <iostream>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/core/intake/shared_trials.h"
#include "tests/support/shared_data.h"

namespace gaitmill {
namespace {

const SignedAxis kUsual{1, 1};

class LaboratoryTest : public SharedDataTest {};

TEST_F(LaboratoryTest, TrialsInGroundAxesStayAsTheyAre) {
  for (const SharedTrial& trial : sharedTrials()) {
    MarkerTrajectories markers = readSharedMarkers(trial);
    const RowMatrix before = markers.positions;
    Decisions decisions;
    const LaboratoryFrame frame =
        decideFrame(markers, findBodyMarkers(markers), {}, kUsual, decisions);
    applyFrame(frame, markers);
    EXPECT_TRUE(frame.R.isIdentity(0.0)) << trial.markers;
    EXPECT_EQ(0,
              std::memcmp(before.data(),
                          markers.positions.data(),
                          sizeof(double) * static_cast<std::size_t>(before.size())));
    ASSERT_EQ(decisions.size(), 2U);
    EXPECT_EQ(decisions[0].value, "y");
    EXPECT_EQ(decisions[1].value, "x");
    EXPECT_EQ(decisions[0].origin, Decision::Origin::kDetected);
    EXPECT_EQ(decisions[1].origin, Decision::Origin::kDetected) << decisions[1].evidence;
    std::cout << trial.markers << ": " << decisions[0].evidence << "; " << decisions[1].evidence
              << "\n";
  }
}

}  // namespace
}  // namespace gaitmill

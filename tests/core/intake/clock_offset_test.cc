#include "core/intake/clock_offset.h"

#include <iostream>

#include <gtest/gtest.h>

#include "tests/core/intake/shared_trials.h"
#include "tests/support/shared_data.h"

namespace gaitmill {
namespace {

class ClockOffsetTest : public SharedDataTest {};
TEST_F(ClockOffsetTest, Explore) {
  for (const SharedTrial& trial : sharedTrials()) {
    const MarkerTrajectories markers = readSharedMarkers(trial);
    GroundReaction forces = readSharedForces(trial);
    const ClockOffset o = findClockOffset(markers, findBodyMarkers(markers), forces);
    std::cout << trial.markers << " " << o.offset << " r " << o.correlation << " r0 "
              << o.correlation_at_zero << "\n";
  }
}

}  // namespace
}  // namespace gaitmill

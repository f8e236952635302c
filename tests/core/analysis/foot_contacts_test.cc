#include "core/analysis/foot_contacts.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

/// A second at 100 Hz on one plate: 500 N under x = 0 from 0.2 to 0.8 s.
GroundReaction makeOneStep() {
  GroundReaction reaction;
  ExternalForce force;
  force.name = "f1";
  force.force = Eigen::Matrix3Xd::Zero(3, 101);
  force.point = Eigen::Matrix3Xd::Zero(3, 101);
  force.torque = Eigen::Matrix3Xd::Zero(3, 101);
  for (int i = 0; i <= 100; ++i) {
    reaction.time.push_back(0.01 * i);
    force.force(1, i) = i >= 20 && i <= 80 ? 500 : 0;
  }
  reaction.forces.push_back(force);
  return reaction;
}

/// The heels at rest.
MarkerTrajectories makeHeels(double right_x, double left_x) {
  MarkerTrajectories markers;
  markers.names = {"RHEE", "LHEE"};
  markers.time = {0, 0.5, 1};
  markers.positions = RowMatrix::Zero(3, 6);
  markers.positions.col(0).setConstant(right_x);
  markers.positions.col(3).setConstant(left_x);
  return markers;
}

Foot findOnlyFoot(const MarkerTrajectories& markers) {
  const std::vector<FootContact> contacts = findFootContacts(
      makeOneStep(), {Foot::kUnknown}, makeGaitMotion(markers, findGaitMarkers(markers.names)));
  EXPECT_EQ(contacts.size(), 1U);
  return contacts.front().foot;
}

TEST(FindFootContacts, ANumberedPlateTakesTheNearerFoot) {
  EXPECT_EQ(findOnlyFoot(makeHeels(0.1, 0.5)), Foot::kRight);
  EXPECT_EQ(findOnlyFoot(makeHeels(0.5, -0.1)), Foot::kLeft);
}

TEST(FindFootContacts, DoesNotGuess) {
  EXPECT_EQ(findOnlyFoot(makeHeels(0.10, 0.12)), Foot::kUnknown);  // both stand there
  EXPECT_EQ(findOnlyFoot(makeHeels(0.5, 0.9)), Foot::kUnknown);    // neither does
  EXPECT_EQ(findOnlyFoot({}), Foot::kUnknown);
  const double unseen = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(findOnlyFoot(makeHeels(unseen, unseen)), Foot::kUnknown);
}

TEST(FindFootContacts, OneFootInSightIsEnough) {
  EXPECT_EQ(findOnlyFoot(makeHeels(std::numeric_limits<double>::quiet_NaN(), 0.1)), Foot::kLeft);
}

TEST(FindGaitEvents, AreStrikesAndToeOffsInTheOrderOfTime) {
  const std::vector<FootContact> contacts = {{"r", Foot::kRight, {0.0, 0.5, false, true}},
                                             {"l", Foot::kLeft, {0.4, 1.0, true, true}},
                                             {"r", Foot::kRight, {0.9, 1.2, true, false}},
                                             {"x", Foot::kUnknown, {0.1, 0.2, true, true}}};
  const std::vector<GaitEvent> events = findGaitEvents(contacts);
  ASSERT_EQ(events.size(), 4U);
  const std::vector<double> times = {0.4, 0.5, 0.9, 1.0};
  const std::vector<Foot> feet = {Foot::kLeft, Foot::kRight, Foot::kRight, Foot::kLeft};
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_EQ(events[i].time, times[i]);
    EXPECT_EQ(events[i].foot, feet[i]);
  }
  EXPECT_EQ(events[0].kind, GaitEvent::Kind::kFootStrike);
  EXPECT_EQ(events[1].kind, GaitEvent::Kind::kToeOff);
}

// Heel on the first plate, toes on the second: one strike, one toe-off.
TEST(FindGaitEvents, AStepAcrossTwoPlatesIsOneStep) {
  const std::vector<GaitEvent> events = findGaitEvents(
      {{"f1", Foot::kRight, {0.1, 0.5, true, true}}, {"f2", Foot::kRight, {0.3, 0.8, true, true}}});
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].time, 0.1);
  EXPECT_EQ(events[1].time, 0.8);
}

// The third strike comes after a step beside the plates: its toe-off is missing.
TEST(FindGaitCycles, NeedOneToeOffBetweenTwoStrikes) {
  using Kind = GaitEvent::Kind;
  const std::vector<GaitEvent> events = {{Kind::kFootStrike, Foot::kRight, 0.1},
                                         {Kind::kFootStrike, Foot::kLeft, 0.6},
                                         {Kind::kToeOff, Foot::kRight, 0.7},
                                         {Kind::kFootStrike, Foot::kRight, 1.1},
                                         {Kind::kToeOff, Foot::kLeft, 1.3},
                                         {Kind::kFootStrike, Foot::kRight, 3.0}};
  const std::vector<GaitCycle> cycles = findGaitCycles(events, Foot::kRight);
  ASSERT_EQ(cycles.size(), 1U);
  EXPECT_EQ(cycles[0].start, 0.1);
  EXPECT_EQ(cycles[0].end, 1.1);
  EXPECT_TRUE(findGaitCycles(events, Foot::kLeft).empty());
}

}  // namespace
}  // namespace gaitmill

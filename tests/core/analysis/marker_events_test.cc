#include "core/analysis/marker_events.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kStride = 1.0;  // [s]

// Feet that swing sinusoidally about a pelvis on a treadmill: the right heel is farthest in front
// at whole seconds, the left one half a second later.
GaitMotion makeSwinging(double amplitude, double rate) {
  GaitMotion motion;
  const int frames = static_cast<int>(4.5 * rate);
  motion.pelvis = Eigen::Matrix3Xd::Zero(3, frames);
  motion.right.heel = motion.right.toe = motion.pelvis;
  motion.left.heel = motion.left.toe = motion.pelvis;
  for (int i = 0; i < frames; ++i) {
    const double t = 0.3 + i / rate;
    motion.time.push_back(t);
    for (auto& [foot, phase] : {std::pair<FootMotion&, double>{motion.right, 0.0},
                                std::pair<FootMotion&, double>{motion.left, 0.5}}) {
      const double angle = 2 * kPi * (t - phase) / kStride;
      foot.heel(0, i) = amplitude * std::cos(angle);
      foot.toe(0, i) = 0.2 + amplitude * std::cos(angle);
      // The toe jerks up 0.06 s before it is farthest behind.
      const double since = std::remainder(t - phase - 0.44, kStride);
      foot.toe(1, i) = 0.05 * std::exp(-0.5 * std::pow((since - 0.08) / 0.045, 2));
    }
  }
  return motion;
}

TEST(FindMarkerEvents, StrikesAreWhereTheHeelTurns) {
  for (const double rate : {60.0, 100.0, 250.0}) {
    int strikes = 0;
    for (const GaitEvent& event : findMarkerEvents(makeSwinging(0.3, rate))) {
      EXPECT_EQ(event.source, GaitEvent::Source::kMarkers);
      if (event.kind == GaitEvent::Kind::kFootStrike) {
        const double phase = event.foot == Foot::kRight ? 0.0 : 0.5;
        // The 7 Hz low-pass has no phase and 1 Hz passes; its ends reach 0.1 s inwards.
        EXPECT_NEAR(std::remainder(event.time - phase, kStride), 0, tol(0.003)) << event.time;
        ++strikes;
      }
    }
    EXPECT_EQ(strikes, 9);  // 4 right, 5 left in 0.3 to 4.8 s
  }
}

TEST(FindMarkerEvents, ToeOffsPrecedeTheTurnOfTheToe) {
  int toe_offs = 0;
  for (const GaitEvent& event : findMarkerEvents(makeSwinging(0.3, 100))) {
    if (event.kind == GaitEvent::Kind::kToeOff) {
      const double phase = event.foot == Foot::kRight ? 0.44 : 0.94;
      EXPECT_NEAR(std::remainder(event.time - phase, kStride), 0, tol(0.02)) << event.time;
      ++toe_offs;
    }
  }
  EXPECT_GE(toe_offs, 7);
}

TEST(FindMarkerEvents, WhoStandsHasNone) {
  EXPECT_TRUE(findMarkerEvents(makeSwinging(0.05, 100)).empty());
  EXPECT_TRUE(findMarkerEvents({}).empty());
}

TEST(FindMarkerEvents, AHiddenFootHasNone) {
  GaitMotion motion = makeSwinging(0.3, 100);
  motion.left.heel.setConstant(std::numeric_limits<double>::quiet_NaN());
  motion.left.toe = motion.left.heel;
  for (const GaitEvent& event : findMarkerEvents(motion)) {
    EXPECT_EQ(event.foot, Foot::kRight);
  }
}

using Kind = GaitEvent::Kind;
const std::vector<GaitEvent> kEvents = {{Kind::kToeOff, Foot::kLeft, 0.2},
                                        {Kind::kFootStrike, Foot::kRight, 0.1},
                                        {Kind::kToeOff, Foot::kRight, 0.7},
                                        {Kind::kFootStrike, Foot::kLeft, 0.6},
                                        {Kind::kFootStrike, Foot::kRight, 1.1}};

TEST(FindStances, ReachToTheEndsOfTheRecord) {
  const std::vector<Stance> stances = findStances(kEvents, 0, 2);
  ASSERT_EQ(stances.size(), 4U);
  EXPECT_EQ(stances[0].foot, Foot::kLeft);
  EXPECT_EQ(stances[0].start, 0);
  EXPECT_EQ(stances[0].end, 0.2);
  EXPECT_FALSE(stances[0].has_strike);
  EXPECT_EQ(stances[1].start, 0.1);
  EXPECT_EQ(stances[1].end, 0.7);
  EXPECT_EQ(stances[2].end, 2);
  EXPECT_FALSE(stances[2].has_toe_off);
  EXPECT_EQ(stances[3].start, 1.1);
}

TEST(CalcDutyFactor, IsTheStanceOfAWholeStride) {
  EXPECT_NEAR(calcDutyFactor(kEvents), 0.6, tol(1e-12));
  EXPECT_TRUE(std::isnan(calcDutyFactor({})));
}

}  // namespace
}  // namespace gaitmill

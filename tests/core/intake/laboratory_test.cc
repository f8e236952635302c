#include "core/intake/laboratory.h"

#include <array>
#include <cstring>
#include <tuple>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/core/intake/shared_trials.h"
#include "tests/support/refusal.h"

namespace gaitmill {
namespace {

constexpr SignedAxis kUsual{1, 1};

/// The recording in another laboratory: p_laboratory = R^T p_ground.
MarkerTrajectories moveTo(const Eigen::Matrix3d& R, MarkerTrajectories markers) {
  applyFrame({R.transpose(), kUsual}, markers);
  return markers;
}

/// Largest difference of any coordinate [m].
double compare(const MarkerTrajectories& a, const MarkerTrajectories& b) {
  double largest = 0;
  for (Eigen::Index i = 0; i < a.positions.size(); ++i) {
    const double difference = std::abs(a.positions.data()[i] - b.positions.data()[i]);
    largest = std::isnan(difference) ? largest : std::max(largest, difference);
  }
  return largest;
}

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
    EXPECT_EQ(std::memcmp(before.data(),
                          markers.positions.data(),
                          sizeof(double) * static_cast<std::size_t>(before.size())),
              0);
    ASSERT_EQ(decisions.size(), 2U);
    EXPECT_EQ(decisions[0].value, "y");
    EXPECT_EQ(decisions[1].value, "x");
    EXPECT_EQ(decisions[0].origin, Decision::Origin::kDetected);
    EXPECT_EQ(decisions[1].origin, Decision::Origin::kDetected) << decisions[1].evidence;
  }
}

TEST_F(LaboratoryTest, EveryAlignedLaboratoryIsTurnedBack) {
  for (const SharedTrial& trial : sharedTrials()) {
    const MarkerTrajectories markers = readSharedMarkers(trial);
    for (int up = 0; up < 6; ++up) {
      for (int ahead = 0; ahead < 6; ++ahead) {
        const SignedAxis vertical{up / 2, up % 2 == 0 ? 1 : -1};
        const SignedAxis forward{ahead / 2, ahead % 2 == 0 ? 1 : -1};
        if (vertical.axis == forward.axis) {
          continue;
        }
        const Eigen::Matrix3d R = makeTurn(forward.direction(), vertical.direction());
        MarkerTrajectories moved = moveTo(R, markers);
        Decisions decisions;
        const LaboratoryFrame frame =
            decideFrame(moved, findBodyMarkers(moved), {}, kUsual, decisions);
        EXPECT_TRUE(frame.R.isApprox(R, 0.0)) << trial.markers << decisions[1].evidence;
        EXPECT_EQ(decisions[0].value, vertical.name());
        EXPECT_EQ(decisions[1].value, forward.name());
        applyFrame(frame, moved);
        EXPECT_LE(compare(moved, markers), 1e-15);
      }
    }
  }
}

TEST_F(LaboratoryTest, ObliqueWalksAreTurnedByTheirAngle) {
  const MarkerTrajectories markers = readSharedMarkers(sharedTrials()[0]);
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(toRadians(35), Eigen::Vector3d::UnitY()).toRotationMatrix();
  const MarkerTrajectories moved = moveTo(R, markers);
  Decisions decisions;
  const LaboratoryFrame frame = decideFrame(moved, findBodyMarkers(moved), {}, kUsual, decisions);
  // The walk itself is not straighter than some degrees.
  EXPECT_LE(Eigen::AngleAxisd(frame.R * R.transpose()).angle(), toRadians(3));
  EXPECT_NE(decisions[1].value.find("deg off"), std::string::npos);
}

TEST_F(LaboratoryTest, SettingsAreBelieved) {
  const MarkerTrajectories markers = readSharedMarkers(sharedTrials()[0]);
  Decisions decisions;
  LaboratoryOptions options;
  options.vertical = SignedAxis{2, 1};
  options.forward = SignedAxis{1, -1};
  const LaboratoryFrame frame =
      decideFrame(markers, findBodyMarkers(markers), options, kUsual, decisions);
  EXPECT_TRUE(frame.R.isApprox(makeTurn(-Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()), 0.0));
  EXPECT_EQ(decisions[0].origin, Decision::Origin::kSet);
  EXPECT_EQ(decisions[1].origin, Decision::Origin::kSet);
  options.forward = SignedAxis{2, 1};
  GAITMILL_EXPECT_ERROR(decideFrame(markers, findBodyMarkers(markers), options, kUsual, decisions),
                        kSettingsValue,
                        "vertical");
}

// Feet that swing forward under a body that slides back: a moving treadmill, or mixed axes.
TEST_F(LaboratoryTest, TravelAgainstTheFeetIsAsked) {
  MarkerTrajectories markers = readSharedMarkers(sharedTrials()[0]);
  for (int frame = 0; frame < markers.frameCount(); ++frame) {
    for (int marker = 0; marker < markers.markerCount(); ++marker) {
      markers.positions(frame, Eigen::Index{3} * marker) -=
          2.5 * markers.time[static_cast<std::size_t>(frame)];
    }
  }
  Decisions decisions;
  GAITMILL_EXPECT_ERROR(decideFrame(markers, findBodyMarkers(markers), {}, kUsual, decisions),
                        kInputAmbiguous,
                        "trial.forward_axis");
}

TEST_F(LaboratoryTest, UnitsThatCannotBeAreReplaced) {
  const MarkerTrajectories markers = readSharedMarkers(sharedTrials()[0]);
  for (const auto& [stated, factor, found] :
       {std::tuple{"m", 1000.0, "mm"}, {"mm", 0.001, "m"}, {"m", 100.0, "cm"}, {"cm", 0.01, "m"}}) {
    MarkerTrajectories wrong = markers;
    wrong.positions *= factor;
    Decisions decisions;
    EXPECT_NEAR(decideMarkerUnit(wrong, stated, {}, decisions) * factor, 1, 1e-12);
    EXPECT_EQ(decisions[0].value, found);
    EXPECT_EQ(decisions[0].origin, Decision::Origin::kDetected);
  }
  Decisions decisions;
  EXPECT_EQ(decideMarkerUnit(markers, "mm", {}, decisions), 1.0);
  EXPECT_EQ(decisions[0].origin, Decision::Origin::kStated);
  MarkerTrajectories giant = markers;
  giant.positions *= 5;
  GAITMILL_EXPECT_ERROR(
      decideMarkerUnit(giant, "m", {}, decisions), kInputAmbiguous, "trial.marker_units");
}

}  // namespace
}  // namespace gaitmill

#include "core/sample/sample_trial.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/math/events.h"
#include "tests/core/sample/sample_subject.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

class SampleTrialTest : public SampleTest {};

TEST_F(SampleTrialTest, NothingIsLeftForThePelvis) {
  const SampleTrial trial = generateSampleTrial(makeSubject());
  for (const char* label : {"pelvis_tx_force",
                            "pelvis_ty_force",
                            "pelvis_tz_force",
                            "pelvis_tilt_moment",
                            "pelvis_list_moment",
                            "pelvis_rotation_moment"}) {
    const double largest =
        trial.moments.values.col(trial.moments.getColumn(label)).cwiseAbs().maxCoeff();
    EXPECT_LT(largest, tol(1e-9)) << label;  // [N|N.m] round-off at 1e3
  }
}

TEST_F(SampleTrialTest, ForcesAreThoseOfWalking) {
  const Model subject = makeSubject();
  const SampleTrial trial = generateSampleTrial(subject);
  const double weight = subject.spec().calcTotalMass() * kGravity;
  for (const ExternalForce& force : trial.ground_reaction.forces) {
    EXPECT_GE(force.force.row(1).minCoeff(), 0.0);
    EXPECT_NEAR(force.force.row(1).maxCoeff() / weight, 1.1, 0.1) << force.name;
    EXPECT_NEAR(force.force.row(0).maxCoeff() / weight, 0.2, 0.05) << force.name;   // push-off
    EXPECT_NEAR(force.force.row(0).minCoeff() / weight, -0.2, 0.05) << force.name;  // braking
    EXPECT_LT(force.torque.row(1).cwiseAbs().maxCoeff(), 12.0) << force.name;       // [N.m]
  }
}

// The foot reaches from the heel marker to 6 cm in front of the toe marker, 5 cm to either side.
TEST_F(SampleTrialTest, CenterOfPressureStaysUnderTheFootAndRollsForward) {
  const Model subject = makeSubject();
  const SampleTrial trial = generateSampleTrial(subject);
  ModelState state(subject);
  for (const ExternalForce& force : trial.ground_reaction.forces) {
    double previous = -1;
    for (int frame = 0; frame < trial.markers.frameCount(); ++frame) {
      const int sample = 2 * frame;  // forces at twice the rate of the markers
      if (force.force(1, sample) < 20) {
        previous = -1;
        continue;
      }
      state.setPose(trial.coordinates.values.row(frame).transpose());
      const Pose& foot = state.pose(subject.getBody(force.body));
      const Eigen::Vector3d p_FP = foot.R.transpose() * (force.point.col(sample) - foot.p);
      EXPECT_GT(p_FP.x(), -0.035) << force.name << " frame " << frame;
      EXPECT_LT(p_FP.x(), 0.265) << force.name << " frame " << frame;
      EXPECT_LT(std::abs(p_FP.z()), 0.04) << force.name << " frame " << frame;
      EXPECT_GT(force.point(0, sample), previous - 0.02) << force.name << " frame " << frame;
      previous = force.point(0, sample);
    }
  }
}

TEST_F(SampleTrialTest, StrikesAreFoundInTheForces) {
  const SampleTrial trial = generateSampleTrial(makeSubject());
  const auto contacts = findContacts(trial.ground_reaction.time,
                                     trial.ground_reaction.forces[0].force.row(1).transpose());
  ASSERT_EQ(contacts.size(), 2U);
  // The quintic share reaches 20 N some 25 ms after the strike itself.
  EXPECT_NEAR(contacts[0].strike, trial.right_strikes[0] + 0.0245, 0.01);
  EXPECT_NEAR(contacts[1].strike, trial.right_strikes[1] + 0.0245, 0.01);
}

TEST_F(SampleTrialTest, MarkersCarryTheStatedNoise) {
  const Model subject = makeSubject();
  SampleOptions exact;
  exact.marker_noise = 0;
  const SampleOptions noisy;
  const SampleTrial truth = generateSampleTrial(subject, exact);
  const SampleTrial trial = generateSampleTrial(subject, noisy);
  const RowMatrix noise = trial.markers.positions - truth.markers.positions;
  const double deviation = std::sqrt(noise.squaredNorm() / static_cast<double>(noise.size()));
  // 175 frames x 126 components: standard error 0.5 %.
  EXPECT_NEAR(deviation, noisy.marker_noise, tol(0.02 * noisy.marker_noise));
  EXPECT_EQ(trial.moments.values, truth.moments.values);
}

TEST_F(SampleTrialTest, ItsMarkersAreTheModelsAtTheTruePose) {
  const Model subject = makeSubject();
  SampleOptions options;
  options.marker_noise = 0;
  const SampleTrial trial = generateSampleTrial(subject, options);
  EXPECT_EQ(trial.markers.markerCount(), 42);
  EXPECT_EQ(trial.static_markers.markerCount(), static_cast<int>(subject.spec().markers.size()));
  ModelState state(subject);
  state.setPose(trial.static_coordinates.values.row(0).transpose());
  const MarkerSpec& heel =
      subject.spec().markers[static_cast<std::size_t>(subject.spec().findMarker("LCAL"))];
  const Eigen::Vector3d expected = state.pose(subject.getBody(heel.body)) * heel.location;
  const int column = *trial.static_markers.findMarker("LCAL");
  EXPECT_LT((trial.static_markers.position(0, column) - expected).norm(), tol(1e-15));
  EXPECT_NEAR(expected.y(), 0.025, 0.01);  // the marker sits 2.5 cm above the sole, on the floor
}

TEST_F(SampleTrialTest, TwiceTheSameBits) {
  const Model subject = makeSubject();
  const SampleTrial a = generateSampleTrial(subject);
  const SampleTrial b = generateSampleTrial(subject);
  EXPECT_EQ(a.markers.positions, b.markers.positions);
  EXPECT_EQ(a.ground_reaction.forces[1].point, b.ground_reaction.forces[1].point);
}

TEST_F(SampleTrialTest, UnknownMarkerIsRefused) {
  SampleOptions options;
  options.tracked_markers = {"NOSE"};
  EXPECT_THROW(generateSampleTrial(makeSubject(), options), Error);
}

}  // namespace
}  // namespace gaitmill

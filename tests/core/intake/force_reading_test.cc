#include "core/intake/force_reading.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/core/intake/shared_trials.h"
#include "tests/support/refusal.h"

namespace gaitmill {
namespace {

/// A trial of ../shared as a laboratory with other conventions would have written its forces.
struct Conventions {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  double direction = 1;
  double point = 1;
  double torque = 1;
};

GroundReaction write(const Conventions& conventions, GroundReaction reaction) {
  for (ExternalForce& force : reaction.forces) {
    force.force = conventions.direction * (conventions.turn * force.force);
    force.point = conventions.point * (conventions.turn * force.point);
    force.torque = conventions.direction * conventions.torque * (conventions.turn * force.torque);
  }
  return reaction;
}

const Decision& findDecision(const Decisions& decisions, const std::string& topic) {
  for (const Decision& decision : decisions) {
    if (decision.topic == topic) {
      return decision;
    }
  }
  throw std::out_of_range(topic);
}

class ForceReadingTest : public SharedDataTest {
 protected:
  void open(const SharedTrial& trial) {
    markers_ = readSharedMarkers(trial);
    body_ = findBodyMarkers(markers_);
    truth_ = readSharedForces(trial);
  }
  GroundReaction read(const Conventions& conventions, const ForceReadingOptions& options = {}) {
    GroundReaction reaction = write(conventions, truth_);
    decisions_.clear();
    warnings_.clear();
    decideForces(markers_, body_, &frame_, options, reaction, decisions_, warnings_);
    return reaction;
  }
  /// Forces and torques everywhere; points where somebody stands.
  void expectTruth(const GroundReaction& found, double tolerance) {
    for (std::size_t i = 0; i < truth_.forces.size(); ++i) {
      const ExternalForce& a = found.forces[i];
      const ExternalForce& b = truth_.forces[i];
      EXPECT_LE((a.force - b.force).cwiseAbs().maxCoeff(), 1000 * tolerance);
      EXPECT_LE((a.torque - b.torque).cwiseAbs().maxCoeff(), 100 * tolerance);
      for (Eigen::Index row = 0; row < b.force.cols(); ++row) {
        if (b.force(1, row) > 0) {
          ASSERT_LE((a.point.col(row) - b.point.col(row)).norm(), 10 * tolerance);
        }
      }
    }
  }

  MarkerTrajectories markers_;
  BodyMarkers body_;
  LaboratoryFrame frame_;
  GroundReaction truth_;
  Decisions decisions_;
  std::vector<std::string> warnings_;
};

TEST_F(ForceReadingTest, TrialsInGroundAxesStayAsTheyAre) {
  for (const SharedTrial& trial : sharedTrials()) {
    open(trial);
    expectTruth(read({}), 0);
    EXPECT_TRUE(warnings_.empty()) << trial.forces << ": " << warnings_[0];
    EXPECT_EQ(findDecision(decisions_, "force_vertical_axis").value, "y");
    EXPECT_EQ(findDecision(decisions_, "force_direction").value, "on_subject");
    EXPECT_EQ(findDecision(decisions_, "force_point_units").value, "m");
    EXPECT_EQ(findDecision(decisions_, "force_moment_units").value, "N.m");
  }
}

// "Axes and plate conventions": the same forces as other laboratories write them.
TEST_F(ForceReadingTest, ConventionsOfOtherLaboratoriesAreSeenThrough) {
  Eigen::Matrix3d z_up;  // x forward, y to the left, z up
  z_up << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  Eigen::Matrix3d half_turn = Eigen::Vector3d(-1, 1, -1).asDiagonal();
  for (const SharedTrial& trial : sharedTrials()) {
    open(trial);
    expectTruth(read({z_up, 1, 1, 1}), 1e-12);
    EXPECT_EQ(findDecision(decisions_, "force_vertical_axis").value, "z");
    expectTruth(read({Eigen::Matrix3d::Identity(), -1, 1, 1}), 1e-12);
    EXPECT_EQ(findDecision(decisions_, "force_direction").value, "on_plate");
    expectTruth(read({z_up, -1, 1000, 1000}), 1e-9);
    EXPECT_EQ(findDecision(decisions_, "force_point_units").value, "mm");
    EXPECT_EQ(findDecision(decisions_, "force_moment_units").value, "N.mm");
  }
  // On the paper's walkway a half turn puts the forces where nobody is.
  open(sharedTrials()[0]);
  expectTruth(read({half_turn, 1, 1, 1}), 1e-12);
  EXPECT_EQ(warnings_.size(), 1U);
}

TEST_F(ForceReadingTest, ForcesOfAnotherPlaceAreWarnedOf) {
  open(sharedTrials()[0]);
  for (ExternalForce& force : truth_.forces) {
    force.point.colwise() += Eigen::Vector3d(9, 0, 4);
  }
  read({});
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_NE(warnings_[0].find("another recording"), std::string::npos);
}

TEST_F(ForceReadingTest, ObliqueForcesAreAsked) {
  open(sharedTrials()[0]);
  const Eigen::Matrix3d leaning =
      Eigen::AngleAxisd(0.78, Eigen::Vector3d::UnitX()).toRotationMatrix();
  GAITMILL_EXPECT_ERROR(read({leaning, 1, 1, 1}), kInputAmbiguous, "trial.force_vertical_axis");
}

TEST_F(ForceReadingTest, SettingsAreBelieved) {
  open(sharedTrials()[1]);
  ForceReadingOptions options;
  options.on_subject = false;
  options.metres_per_unit = 0.01;
  options.moment_factor = 0.001;
  const GroundReaction read_so = read({}, options);
  EXPECT_EQ(read_so.forces[0].force, Eigen::Matrix3Xd(-truth_.forces[0].force));
  EXPECT_EQ(findDecision(decisions_, "force_direction").origin, Decision::Origin::kSet);
  EXPECT_EQ(findDecision(decisions_, "force_point_units").value, "cm");
  EXPECT_EQ(findDecision(decisions_, "force_moment_units").value, "N.mm");
}

}  // namespace
}  // namespace gaitmill

#include "core/model/muscle_paths.h"

#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "core/model/model.h"
#include "tests/support/model_files.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

/// Poses of a person in motion: within the ranges, but not at their ends.
Eigen::VectorXd makeGaitLikePose(const Model& model, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  Eigen::VectorXd q = model.defaultPose();
  const auto set = [&](const std::string& name, double low, double high) {
    q[model.getCoordinate(name).value()] = low + (high - low) * unit(generator);
  };
  for (const std::string side : {"_r", "_l"}) {
    set("hip_flexion" + side, -0.35, 0.8);
    set("hip_adduction" + side, -0.25, 0.2);
    set("hip_rotation" + side, -0.3, 0.3);
    set("knee_angle" + side, 0.02, 1.3);
    set("ankle_angle" + side, -0.5, 0.4);
    set("subtalar_angle" + side, -0.2, 0.2);
    set("mtp_angle" + side, -0.3, 0.3);
    q[model.getCoordinate("knee_angle" + side + "_beta").value()] =
        q[model.getCoordinate("knee_angle" + side).value()];
  }
  return q;
}

class MusclePathsTest : public ::testing::Test {
 protected:
  Model model_{readOwnModel()};
  ModelState state_{model_};
  MusclePaths paths_{model_};

  Eigen::VectorXd calcLengths(const Eigen::VectorXd& q) {
    state_.setPose(q);
    paths_.calc(state_);
    return paths_.lengths();
  }
};

// For a geodesic the force route and the derivative of the length are the same number.
TEST_F(MusclePathsTest, MomentArmsAreTheDerivativeOfTheLengthForAllMuscles) {
  // Short steps, so that a pose where a wrap begins (a kink of the arm) falls between them rarely.
  constexpr double h = 2e-6;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Eigen::VectorXd q = makeGaitLikePose(model_, seed);
    calcLengths(q);
    const RowMatrix arms = paths_.momentArms();
    for (int c = 0; c < model_.coordinateCount(); ++c) {
      const auto lengthsAt = [&](double step) {
        Eigen::VectorXd moved = q;
        moved[c] += step * h;
        return calcLengths(moved);
      };
      const Eigen::VectorXd slope = (lengthsAt(1) - lengthsAt(-1)) / (2 * h);
      for (int m = 0; m < model_.muscleCount(); ++m) {
        EXPECT_NEAR(arms(m, c), -slope[m], tol(1e-8))
            << model_.spec().muscles[static_cast<std::size_t>(m)].name << " "
            << model_.coordinateNames()[static_cast<std::size_t>(c)] << " seed " << seed;
      }
    }
  }
}

TEST_F(MusclePathsTest, LeftAndRightAreMirrorImages) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Eigen::VectorXd q = makeGaitLikePose(model_, seed);
    for (const std::string name : {"hip_flexion",
                                   "hip_adduction",
                                   "hip_rotation",
                                   "knee_angle",
                                   "ankle_angle",
                                   "subtalar_angle",
                                   "mtp_angle"}) {
      q[model_.getCoordinate(name + "_l").value()] = q[model_.getCoordinate(name + "_r").value()];
    }
    q[model_.getCoordinate("knee_angle_l_beta").value()] =
        q[model_.getCoordinate("knee_angle_r_beta").value()];
    const Eigen::VectorXd lengths = calcLengths(q);
    for (int m = 0; m < 40; ++m) {
      // The document's left toe joint is 5.3e-6 rad off the mirror image: 6e-8 m for the toe
      // muscles.
      EXPECT_NEAR(lengths[m], lengths[m + 40], tol(7e-8))
          << model_.spec().muscles[static_cast<std::size_t>(m)].name << " seed " << seed;
    }
  }
}

struct ExactLength {
  const char* muscle;
  double pose_0, pose_a;
};

// Exact lengths of spec/path.md 9: every muscle with a wrap, and two without.
TEST_F(MusclePathsTest, LengthsMatchTheExactValues) {
  const std::vector<ExactLength> table = {
      {"addbrev", 0.14019355574, 0.13166112453},    {"addlong", 0.24395195895, 0.22771330319},
      {"addmagDist", 0.22282143956, 0.24480315565}, {"addmagIsch", 0.33926462069, 0.36724691531},
      {"addmagMid", 0.14349591510, 0.15380326582},  {"addmagProx", 0.11630876979, 0.11367525736},
      {"bfsh", 0.23793663342, 0.21609730662},       {"gaslat", 0.45014128276, 0.43555337947},
      {"gasmed", 0.46293795133, 0.45041860920},     {"glmax1", 0.19145414010, 0.21270624969},
      {"glmax2", 0.21840899577, 0.24673349973},     {"glmax3", 0.21889231569, 0.26129628032},
      {"grac", 0.43855863100, 0.41777947741},       {"iliacus", 0.20770324993, 0.18895057837},
      {"psoas", 0.22882630013, 0.21683244953},      {"recfem", 0.51205732064, 0.52691783269},
      {"semimem", 0.41151874825, 0.40612075663},    {"semiten", 0.45403140336, 0.44797660776},
      {"vasint", 0.28211692009, 0.31597244785},     {"vaslat", 0.29572321717, 0.32986985356},
      {"vasmed", 0.27020944677, 0.30322873211},     {"soleus", 0.32283650320, 0.32669487350},
      {"edl", 0.43730829135, 0.43494374574}};
  Eigen::VectorXd q = model_.defaultPose();
  const Eigen::VectorXd pose_0 = calcLengths(q);
  const auto set = [&](const char* name, double value) {
    q[model_.getCoordinate(name).value()] = value;
  };
  set("hip_flexion_r", 0.5);
  set("hip_adduction_r", -0.1);
  set("hip_rotation_r", 0.1);
  set("knee_angle_r", 0.8);
  set("knee_angle_r_beta", 0.8);
  set("ankle_angle_r", 0.1);
  set("subtalar_angle_r", 0.05);
  set("mtp_angle_r", 0.1);
  const Eigen::VectorXd pose_a = calcLengths(q);
  for (const ExactLength& row : table) {
    const int m = model_.spec().findMuscle(std::string(row.muscle) + "_r");
    EXPECT_NEAR(pose_0[m], row.pose_0, tol(1e-9)) << row.muscle;
    EXPECT_NEAR(pose_a[m], row.pose_a, tol(1e-9)) << row.muscle;
  }
}

TEST_F(MusclePathsTest, AnswerDoesNotDependOnThePoseBefore) {
  const Eigen::VectorXd q = makeGaitLikePose(model_, 4);
  const Eigen::VectorXd first = calcLengths(q);
  calcLengths(makeGaitLikePose(model_, 5));
  EXPECT_EQ((calcLengths(q) - first).cwiseAbs().maxCoeff(), 0.0);
}

TEST_F(MusclePathsTest, SpeedIsTheChangeOfLengthInTime) {
  const Eigen::VectorXd q = makeGaitLikePose(model_, 6);
  Eigen::VectorXd u(model_.coordinateCount());
  for (int c = 0; c < u.size(); ++c) {
    u[c] = std::cos(0.9 * c);
  }
  constexpr double h = 1e-5;
  const Eigen::VectorXd slope = (calcLengths(q + h * u) - calcLengths(q - h * u)) / (2 * h);
  calcLengths(q);
  Eigen::VectorXd speeds(model_.muscleCount());
  paths_.calcSpeeds(u, speeds);
  EXPECT_LT((speeds - slope).cwiseAbs().maxCoeff(), tol(1e-7));
}

}  // namespace
}  // namespace gaitmill

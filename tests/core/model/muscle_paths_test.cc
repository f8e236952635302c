#include "core/model/muscle_paths.h"

#include <cmath>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/model/model.h"
#include "tests/support/model_files.h"
#include "tests/support/shared_data.h"
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

/// Pose A of spec/path.md 9 and its speeds; the other coordinates are at their defaults.
struct PoseA {
  Eigen::VectorXd q, u;

  explicit PoseA(const Model& model)
      : q(model.defaultPose()), u(Eigen::VectorXd::Zero(model.coordinateCount())) {
    const auto set = [&](const char* name, double value, double speed) {
      q[model.getCoordinate(name).value()] = value;
      u[model.getCoordinate(name).value()] = speed;
    };
    set("hip_flexion_r", 0.5, 1);
    set("hip_adduction_r", -0.1, -0.5);
    set("hip_rotation_r", 0.1, 0.3);
    set("knee_angle_r", 0.8, -2);
    set("knee_angle_r_beta", 0.8, -2);
    set("ankle_angle_r", 0.1, 1.5);
    set("subtalar_angle_r", 0.05, 0);
    set("mtp_angle_r", 0.1, 0);
  }
};

/// The exact values of spec/path.md 9, read from its tables: those whose header row starts as
/// given, in order. Each row is a muscle and its numbers.
class ExactPathTest : public SharedDataTest {
 protected:
  using Row = std::pair<std::string, std::vector<double>>;

  std::vector<std::vector<Row>> readTables(const std::string& header) const {
    std::ifstream file(shared("spec/path.md"));
    std::vector<std::vector<Row>> tables;
    bool inside = false;
    for (std::string line; std::getline(file, line);) {
      if (line.rfind(header, 0) == 0) {
        tables.emplace_back();
        inside = true;
      } else if (line.empty() || line[0] != '|') {
        inside = false;
      } else if (inside && line.rfind("|---", 0) != 0) {
        tables.back().push_back(parseRow(line));
      }
    }
    return tables;
  }

  Model model_{readOwnModel()};
  ModelState state_{model_};
  MusclePaths paths_{model_};

  int findMuscle(const Row& row) const { return model_.spec().findMuscle(row.first + "_r"); }
  Eigen::VectorXd calcLengthsAtKnee(const Eigen::VectorXd& pose, double knee) {
    Eigen::VectorXd q = pose;
    q[model_.getCoordinate("knee_angle_r").value()] = knee;
    q[model_.getCoordinate("knee_angle_r_beta").value()] = knee;
    state_.setPose(q);
    paths_.calc(state_);
    return paths_.lengths();
  }
  void checkArms(const Eigen::VectorXd& pose, const std::vector<Row>& rows) {
    ASSERT_EQ(rows.size(), 40U);
    const double knee = pose[model_.getCoordinate("knee_angle_r").value()];
    // The tables' knee arms are four-point differences of the length with a step of 1e-4 rad, which
    // straddles the end of the knee's splines at 0 (up to 7e-7 m there). So they are compared with
    // the same differences of our lengths; arms against derivatives have a test of their own.
    constexpr double h = 1e-4;
    const Eigen::VectorXd knee_arms =
        -(8 * (calcLengthsAtKnee(pose, knee + h) - calcLengthsAtKnee(pose, knee - h)) -
          (calcLengthsAtKnee(pose, knee + 2 * h) - calcLengthsAtKnee(pose, knee - 2 * h))) /
        (12 * h);
    calcLengthsAtKnee(pose, knee);
    const std::vector<std::string> names = {"hip_flexion_r",
                                            "hip_adduction_r",
                                            "hip_rotation_r",
                                            "knee_angle_r",
                                            "ankle_angle_r",
                                            "subtalar_angle_r"};
    for (const Row& row : rows) {
      // Of the two-wrap gastrocnemii the tables stopped iterating the length at 1e-12 m, which
      // leaves their tangent points, and so these arms, good to some 1e-9 m only.
      const double bound = row.first == "gaslat" || row.first == "gasmed" ? 1e-8 : 1e-9;
      for (std::size_t k = 0; k < names.size(); ++k) {
        const double arm =
            names[k] == "knee_angle_r"
                ? knee_arms[findMuscle(row)]
                : paths_.momentArms()(findMuscle(row), model_.getCoordinate(names[k]).value());
        EXPECT_NEAR(arm, row.second.at(k), tol(bound)) << row.first << " " << names[k];
      }
    }
  }

 private:
  static Row parseRow(const std::string& line) {
    std::stringstream cells(line.substr(1));
    std::string cell;
    std::getline(cells, cell, '|');
    Row row;
    std::stringstream(cell) >> row.first;
    while (std::getline(cells, cell, '|')) {
      double value = 0;
      if (std::stringstream(cell) >> value) {
        row.second.push_back(value);
      }
    }
    return row;
  }
};

TEST_F(ExactPathTest, LengthsAndSpeedsOfTheRightLeg) {
  const auto tables = readTables("| muscle | L pose 0 exact");
  ASSERT_EQ(tables.size(), 1U);
  ASSERT_EQ(tables[0].size(), 40U);
  state_.setPose(model_.defaultPose());
  paths_.calc(state_);
  const Eigen::VectorXd pose_0 = paths_.lengths();
  const PoseA pose_a(model_);
  state_.setPose(pose_a.q);
  paths_.calc(state_);
  Eigen::VectorXd speeds(model_.muscleCount());
  paths_.calcSpeeds(pose_a.u, speeds);
  for (const Row& row : tables[0]) {
    const int m = findMuscle(row);
    EXPECT_NEAR(pose_0[m], row.second.at(0), tol(1e-9)) << row.first;
    EXPECT_NEAR(paths_.lengths()[m], row.second.at(2), tol(1e-9)) << row.first;
    EXPECT_NEAR(speeds[m], row.second.at(4), tol(1e-9)) << row.first;
  }
}

TEST_F(ExactPathTest, MomentArmsOfTheRightLeg) {
  // Exact pose A, OpenSim's pose A (only the muscles that differ), exact pose 0.
  const auto tables = readTables("| muscle | hip flex | hip add");
  ASSERT_EQ(tables.size(), 3U);
  checkArms(PoseA(model_).q, tables[0]);
  checkArms(model_.defaultPose(), tables[2]);
}

TEST_F(MusclePathsTest, AnswerDoesNotDependOnThePoseBefore) {
  const Eigen::VectorXd q = makeGaitLikePose(model_, 4);
  const Eigen::VectorXd first = calcLengths(q);
  calcLengths(makeGaitLikePose(model_, 5));
  EXPECT_EQ((calcLengths(q) - first).cwiseAbs().maxCoeff(), 0.0);
}

// Fine chords add up to the path's length, and tension along them has the path's moment arms.
TEST_F(MusclePathsTest, TracedPathHasTheLengthAndTheMomentArmsOfThePath) {
  std::vector<PathVertex> vertices;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    calcLengths(makeGaitLikePose(model_, seed));
    const Eigen::VectorXd lengths = paths_.lengths();
    const RowMatrix arms = paths_.momentArms();
    for (int m = 0; m < model_.muscleCount(); ++m) {
      SCOPED_TRACE(model_.spec().muscles[static_cast<std::size_t>(m)].name);
      paths_.tracePath(state_, MuscleIndex(m), 1e-3, vertices);
      double length = 0;
      Eigen::VectorXd generalized = Eigen::VectorXd::Zero(model_.coordinateCount());
      for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
        const Eigen::Vector3d d = vertices[i + 1].p_G - vertices[i].p_G;
        length += d.norm();
        const Eigen::Vector3d pull = d.normalized();
        Vector6 wrench;
        wrench << vertices[i].p_G.cross(pull), pull;
        if (vertices[i].body != vertices[i + 1].body) {
          state_.addWrench({vertices[i].body, wrench}, generalized);
          state_.addWrench({vertices[i + 1].body, -wrench}, generalized);
        }
      }
      EXPECT_NEAR(length, lengths[m], 1e-6 * lengths[m]);
      EXPECT_LT((generalized.transpose() - arms.row(m)).cwiseAbs().maxCoeff(), 1e-9);
    }
  }
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

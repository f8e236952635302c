#include "core/model/muscle_paths.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/math/scalar_function.h"
#include "core/model/model.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/model_files.h"
#include "tests/support/shared_data.h"
#include "tests/support/simple_models.h"
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

// A bob on a pin about z, a path from ground to a point of the bob.
ModelSpec makePendulumWithPath(const PathPointSpec& last) {
  ModelSpec spec = makePendulum(1.0, 0.5);
  spec.joints[0].coordinates[0].range_min = -1;
  spec.joints[0].coordinates[0].range_max = 1;
  MuscleSpec muscle;
  muscle.name = "m";
  muscle.path = {{"ground", {0.3, 0.1, 0}}, last};
  spec.muscles = {muscle};
  return spec;
}

PathPointSpec makeMovingPoint(const std::string& body) {
  PathPointSpec point;
  point.body = body;
  point.kind = PathPointSpec::Kind::kMoving;
  point.coordinate = "angle";
  point.location_functions[0] = {FunctionSpec::Kind::kPolynomial, {}, {0.3, 0.2, 0.1}, 1};
  point.location_functions[1] = {FunctionSpec::Kind::kLinear, {}, {-0.1, -0.4}, 2};
  return point;
}

// The point at (x, y)(q) of the bob, turned by q: a path in closed form.
TEST(MusclePathPoints, MovingPointMatchesTheClosedForm) {
  const Model model(makePendulumWithPath(makeMovingPoint("bob")));
  ModelState state(model);
  MusclePaths paths(model);
  for (const double q : {-0.9, -0.2, 0.0, 0.7}) {
    const Eigen::Vector2d p(0.3 * q * q + 0.2 * q + 0.1, -0.2 * q - 0.8);
    const Eigen::Vector2d slope(0.6 * q + 0.2, -0.2);
    const Eigen::Rotation2Dd turn(q);
    const Eigen::Vector2d placed = turn * p;
    const Eigen::Vector2d rate = turn * slope + Eigen::Vector2d(-placed.y(), placed.x());
    const Eigen::Vector2d d = placed - Eigen::Vector2d(0.3, 0.1);
    state.setPose(Eigen::VectorXd::Constant(1, q));
    paths.calc(state);
    EXPECT_NEAR(paths.lengths()[0], d.norm(), tol(1e-15));
    EXPECT_NEAR(paths.momentArms()(0, 0), -rate.dot(d) / d.norm(), tol(1e-14));
    Eigen::VectorXd speeds(1);
    paths.calcSpeeds(Eigen::VectorXd::Constant(1, 3.0), speeds);
    EXPECT_NEAR(speeds[0], 3 * rate.dot(d) / d.norm(), tol(1e-14));
  }
}

// OpenSim forgets this part (spec/path.md 3); the length changes all the same.
TEST(MusclePathPoints, MovingPointBesideItsNeighbourOnOneBodyHasAnArm) {
  const Model model(makePendulumWithPath(makeMovingPoint("ground")));
  ModelState state(model);
  MusclePaths paths(model);
  const double q = 0.4;
  const Eigen::Vector2d d(0.3 * q * q + 0.2 * q + 0.1 - 0.3, -0.2 * q - 0.8 - 0.1);
  state.setPose(Eigen::VectorXd::Constant(1, q));
  paths.calc(state);
  EXPECT_NEAR(paths.momentArms()(0, 0),
              -Eigen::Vector2d(0.6 * q + 0.2, -0.2).dot(d) / d.norm(),
              tol(1e-15));
}

TEST(MusclePathPoints, MovingPointRestsBeyondTheRangeOfItsCoordinate) {
  const Model model(makePendulumWithPath(makeMovingPoint("ground")));
  ModelState state(model);
  MusclePaths paths(model);
  const auto lengthAt = [&](double q) {
    state.setPose(Eigen::VectorXd::Constant(1, q));
    paths.calc(state);
    return paths.lengths()[0];
  };
  EXPECT_EQ(lengthAt(1.5), lengthAt(1.0));
  EXPECT_EQ(lengthAt(-1.5), lengthAt(-1.0));
  EXPECT_NE(lengthAt(0.9), lengthAt(1.0));
  lengthAt(1.5);
  EXPECT_EQ(paths.momentArms()(0, 0), 0);
}

TEST(MusclePathPoints, MovingPointWithoutCoordinateStandsAtZero) {
  PathPointSpec point = makeMovingPoint("ground");
  point.coordinate = "";
  const Model model(makePendulumWithPath(point));
  ModelState state(model);
  MusclePaths paths(model);
  state.setPose(Eigen::VectorXd::Constant(1, 0.5));
  paths.calc(state);
  EXPECT_NEAR(paths.lengths()[0], std::hypot(0.2, 0.9), tol(1e-15));
  EXPECT_EQ(paths.momentArms()(0, 0), 0);
}

TEST(MusclePathPoints, ConditionalPointIsPartOfThePathInsideItsRange) {
  ModelSpec spec = makePendulumWithPath({"ground", {-0.3, 0.1, 0}});
  PathPointSpec via{"ground", {0, 0.5, 0}};
  via.kind = PathPointSpec::Kind::kConditional;
  via.coordinate = "angle";
  via.range_min = -0.2;
  via.range_max = 0.3;
  PathPointSpec never = via;
  never.location.y() = 7;
  never.coordinate = "";
  auto& path = spec.muscles[0].path;
  path.insert(path.begin() + 1, {via, never});
  const Model model(spec);
  ModelState state(model);
  MusclePaths paths(model);
  std::vector<PathVertex> vertices;
  const auto countAt = [&](double q) {
    state.setPose(Eigen::VectorXd::Constant(1, q));
    paths.calc(state);
    paths.tracePath(state, MuscleIndex(0), 1.0, vertices);
    EXPECT_EQ(paths.lengths()[0], vertices.size() == 3 ? 1.0 : 0.6) << q;
    return vertices.size();
  };
  // A condition holds within 1e-5 beyond its range.
  EXPECT_EQ(countAt(0.0), 3u);
  EXPECT_EQ(countAt(-0.200009), 3u);
  EXPECT_EQ(countAt(-0.200011), 2u);
  EXPECT_EQ(countAt(0.300009), 3u);
  EXPECT_EQ(countAt(0.300011), 2u);
}

// The range of a wrap counts all points; where its last one is left out of the path, the wrap ends
// at the point before.
TEST(MusclePathPoints, WrapRangeEndsAtTheLastPointThatIsPartOfThePath) {
  ModelSpec spec = makePendulumWithPath({"ground", {-0.3, -0.1, 0}});
  WrapObjectSpec cylinder;
  cylinder.name = "rod";
  cylinder.radius = 0.05;
  spec.ground_wrap_objects = {cylinder};
  PathPointSpec via{"ground", {0.2, 0.01, 0}};
  via.kind = PathPointSpec::Kind::kConditional;
  via.coordinate = "angle";
  via.range_min = -0.5;
  via.range_max = 0;
  auto& path = spec.muscles[0].path;
  path = {{"ground", {0.4, 0.02, 0}}, {"ground", {0.3, 0.01, 0}}, via, {"ground", {-0.3, 0.01, 0}}};
  const auto wrapsAt = [&](int first, int last, double q) {
    spec.muscles[0].wraps = {{"rod", first, last}};
    const Model model(spec);
    ModelState state(model);
    MusclePaths paths(model);
    state.setPose(Eigen::VectorXd::Constant(1, q));
    paths.calc(state);
    return paths.findWrapCount(MuscleIndex(0));
  };
  for (const double q : {-0.1, 0.1}) {
    EXPECT_EQ(wrapsAt(-1, -1, q), 1) << q;
    EXPECT_EQ(wrapsAt(1, 3, q), 0) << q;
    EXPECT_EQ(wrapsAt(2, 4, q), 1) << q;
  }
  // The range begins at the point that is missing: at the next one, which is the last.
  EXPECT_EQ(wrapsAt(3, 4, -0.1), 1);
  EXPECT_EQ(wrapsAt(3, 4, 0.1), 0);
}

/// The models of the Delp lineage, whose paths have conditional and moving points.
class DelpPathTest : public SharedDataTest {
 protected:
  // Every coordinate over its whole range while the others stand anywhere in theirs.
  static void checkArms(const Model& model) {
    constexpr double h = 4e-6;
    constexpr int kSteps = 12;
    ModelState state(model);
    MusclePaths paths(model);
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> unit(0, 1);
    const auto lengthsAt = [&](Eigen::VectorXd q, int c, double step) -> Eigen::VectorXd {
      q[c] += step;
      state.setPose(q);
      paths.calc(state);
      return paths.lengths();
    };
    double worst = 0;
    for (int c = 0; c < model.coordinateCount(); ++c) {
      for (int step = 0; step < kSteps; ++step) {
        Eigen::VectorXd q(model.coordinateCount());
        for (int k = 0; k < q.size(); ++k) {
          const CoordinateSpec& spec = model.coordinate(CoordinateIndex(k));
          const double share = k == c ? (step + 0.5) / kSteps : unit(generator);
          q[k] = spec.range_min + share * (spec.range_max - spec.range_min);
        }
        // Five points: the error of the difference is round-off, some 1e-16 m / h.
        const Eigen::VectorXd slope = (8 * (lengthsAt(q, c, h) - lengthsAt(q, c, -h)) -
                                       (lengthsAt(q, c, 2 * h) - lengthsAt(q, c, -2 * h))) /
                                      (12 * h);
        lengthsAt(q, c, 0);
        worst = std::max(worst, (paths.momentArms().col(c) + slope).cwiseAbs().maxCoeff());
      }
    }
    EXPECT_LT(worst, tol(1e-9));
  }
};

TEST_F(DelpPathTest, MomentArmsOfGait2392AreTheDerivativeOfTheLength) {
  checkArms(Model(readModelFile(shared("data/models/gait2392_millard2012muscle.osim"))));
}

TEST_F(DelpPathTest, MomentArmsOfHamner2010AreTheDerivativeOfTheLength) {
  checkArms(Model(readModelFile(shared("data/models/FullBodyModel_Hamner2010_v2_0.osim"))));
}

// Quadriceps of gait2392 over the knee's range: their arm extends the knee and stays of the size of
// a patellar tendon's, and the moving point carries a good part of it.
TEST_F(DelpPathTest, QuadricepsExtendTheKneeOverItsWholeRange) {
  const Model model(readModelFile(shared("data/models/gait2392_millard2012muscle.osim")));
  ModelState state(model);
  MusclePaths paths(model);
  const int knee = model.getCoordinate("knee_angle_r").value();
  const int rectus = model.spec().findMuscle("rect_fem_r");
  for (double angle = -2.0; angle < 0.01; angle += 0.1) {
    Eigen::VectorXd q = model.defaultPose();
    q[knee] = angle;
    state.setPose(q);
    paths.calc(state);
    // The knee's angle is negative in flexion: extension is the positive direction.
    EXPECT_GT(paths.momentArms()(rectus, knee), 0.015) << angle;
    EXPECT_LT(paths.momentArms()(rectus, knee), 0.06) << angle;
  }
}

/// The leg of Arnold et al. (2010), whose paths wrap over ellipsoids and cylinders. The muscles'
/// own equations do not matter to their paths.
class ArnoldLegTest : public SharedDataTest {
 protected:
  void SetUp() override {
    SharedDataTest::SetUp();
    if (IsSkipped()) {
      return;
    }
    std::string text = readFile(shared("data/models/Arnold2010_right_leg_27musc.osim"));
    const std::string type = "Schutte1993Muscle_Deprecated";
    for (std::size_t at = text.find(type); at != std::string::npos; at = text.find(type, at)) {
      text.replace(at, type.size(), "Millard2012EquilibriumMuscle");
    }
    model_ = std::make_unique<Model>(readOsim(text, "arnold.osim"));
    state_ = std::make_unique<ModelState>(*model_);
    paths_ = std::make_unique<MusclePaths>(*model_);
  }

  /// A pose somewhere in the ranges of hip and knee, the patella where it belongs.
  Eigen::VectorXd makePose(unsigned seed) const {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> unit(0.02, 0.98);
    Eigen::VectorXd q = model_->defaultPose();
    for (const std::string name : {"hip_flexion", "hip_adduction", "hip_rotation", "knee_angle"}) {
      const CoordinateIndex c = model_->getCoordinate(name);
      const CoordinateSpec& spec = model_->coordinate(c);
      q[c.value()] = spec.range_min + (spec.range_max - spec.range_min) * unit(generator);
    }
    return followCouplers(q);
  }

  Eigen::VectorXd followCouplers(Eigen::VectorXd q) const {
    for (const CouplerSpec& coupler : model_->spec().couplers) {
      q[model_->getCoordinate(coupler.dependent).value()] =
          coupler.scale * ScalarFunction(coupler.function)
                              .evaluate(q[model_->getCoordinate(coupler.independent).value()])
                              .value;
    }
    return q;
  }

  Eigen::VectorXd calcLengths(const Eigen::VectorXd& q) {
    state_->setPose(q);
    paths_->calc(*state_);
    return paths_->lengths();
  }

  std::unique_ptr<Model> model_;
  std::unique_ptr<ModelState> state_;
  std::unique_ptr<MusclePaths> paths_;
};

TEST_F(ArnoldLegTest, MomentArmsAreTheDerivativeOfTheLengthOverTheRanges) {
  constexpr double h = 1e-6;
  std::vector<int> wrapped(static_cast<std::size_t>(model_->muscleCount()), 0);
  int compared = 0, apart = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const Eigen::VectorXd q = makePose(seed);
    calcLengths(q);
    const RowMatrix arms = paths_->momentArms();
    for (int m = 0; m < model_->muscleCount(); ++m) {
      wrapped[static_cast<std::size_t>(m)] += paths_->findWrapCount(MuscleIndex(m));
    }
    for (int c = 0; c < model_->coordinateCount(); ++c) {
      const auto lengthsAt = [&](double step) {
        Eigen::VectorXd moved = q;
        moved[c] += step * h;
        return calcLengths(moved);
      };
      const Eigen::VectorXd slope = (lengthsAt(1) - lengthsAt(-1)) / (2 * h);
      for (int m = 0; m < model_->muscleCount(); ++m) {
        ++compared;
        const bool equal = std::abs(arms(m, c) + slope[m]) < tol(2e-7);
        apart += equal ? 0 : 1;
        EXPECT_TRUE(equal) << model_->spec().muscles[static_cast<std::size_t>(m)].name << " "
                           << model_->coordinateNames()[static_cast<std::size_t>(c)] << " seed "
                           << seed << ": " << arms(m, c) << " against " << -slope[m];
      }
    }
  }
  EXPECT_EQ(apart, 0) << "of " << compared;
  EXPECT_GE(std::count_if(wrapped.begin(), wrapped.end(), [](int n) { return n > 0; }), 12);
}

// Through the ranges in small steps no path jumps: its length changes by what its arm says.
TEST_F(ArnoldLegTest, LengthsAreContinuousOverTheRanges) {
  constexpr int kSteps = 400;
  for (const std::string name : {"hip_flexion", "hip_adduction", "hip_rotation", "knee_angle"}) {
    const CoordinateIndex c = model_->getCoordinate(name);
    const CoordinateSpec& range = model_->coordinate(c);
    const double step = (range.range_max - range.range_min) / kSteps;
    Eigen::VectorXd last;
    for (int i = 0; i <= kSteps; ++i) {
      Eigen::VectorXd q = model_->defaultPose();
      q[c.value()] = range.range_min + step * i;
      const Eigen::VectorXd lengths = calcLengths(followCouplers(q));
      for (int m = 0; i > 0 && m < model_->muscleCount(); ++m) {
        // No arm here is longer than 0.1 m.
        EXPECT_LT(std::abs(lengths[m] - last[m]), 0.1 * step)
            << model_->spec().muscles[static_cast<std::size_t>(m)].name << " " << name << " step "
            << i;
      }
      last = lengths;
    }
  }
}

TEST_F(ArnoldLegTest, CalcDoesNotAllocate) {
  const Eigen::VectorXd q = makePose(1);
  calcLengths(q);
  EXPECT_EQ(countAllocationsOf([&] { paths_->calc(*state_); }), 0);
}

// What is drawn lies on the surfaces: no vertex of a wrapped path is inside its ellipsoid.
TEST_F(ArnoldLegTest, TracedArcsLieOnTheirEllipsoids) {
  int on_surface = 0;
  calcLengths(makePose(3));
  for (int m = 0; m < model_->muscleCount(); ++m) {
    const MuscleSpec& muscle = model_->spec().muscles[static_cast<std::size_t>(m)];
    std::vector<PathVertex> path;
    paths_->tracePath(*state_, MuscleIndex(m), 0.1, path);
    double length = 0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      length += (path[i + 1].p_G - path[i].p_G).norm();
    }
    EXPECT_NEAR(length, paths_->lengths()[m], tol(2e-4)) << muscle.name;
    on_surface += path.size() > muscle.path.size() + 2 ? 1 : 0;
  }
  EXPECT_GE(on_surface, 5);
}

}  // namespace
}  // namespace gaitmill

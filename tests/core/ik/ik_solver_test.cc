#include "core/ik/ik_solver.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/model_files.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The project's model walking on the spot: every free coordinate swings inside its range.
class IkSolverTest : public ::testing::Test {
 protected:
  IkSolverTest() {
    for (const MarkerSpec& marker : model_.spec().markers) {
      options_.tasks.markers.push_back({marker.name, 1.0});
      trial_.names.push_back(marker.name);
    }
    truth_ = RowMatrix(kFrames, model_.coordinateCount());
    trial_.positions = RowMatrix(kFrames, 3 * trial_.markerCount());
    for (int frame = 0; frame < kFrames; ++frame) {
      trial_.time.push_back(0.01 * frame);
      Eigen::VectorXd q = makePose(0.01 * frame);
      truth_.row(frame) = q.transpose();
      trial_.positions.row(frame) = measure(q).transpose();
    }
  }

  Eigen::VectorXd makePose(double t) const {
    Eigen::VectorXd q = model_.defaultPose();
    for (const CoordinateIndex c : free_.indices()) {
      const CoordinateSpec& spec = model_.coordinate(c);
      const double middle = 0.5 * (spec.range_min + spec.range_max);
      const double swing = 0.15 * (spec.range_max - spec.range_min);
      q[c.value()] = middle + swing * std::sin(6 * t + c.value());
    }
    free_.conformPose(q);
    return q;
  }

  Eigen::VectorXd measure(const Eigen::VectorXd& q) const {
    ModelState state(model_);
    state.setPose(q);
    Eigen::VectorXd positions(3 * trial_.markerCount());
    int i = 0;
    for (const MarkerSpec& marker : model_.spec().markers) {
      positions.segment<3>(3 * i++) = state.pose(model_.getBody(marker.body)) * marker.location;
    }
    return positions;
  }

  IkResult solve() { return IkSolver(model_, options_, trial_.names).solve(trial_); }

  static constexpr int kFrames = 40;
  Model model_{readOwnModel()};
  FreeCoordinates free_{model_};
  IkOptions options_;
  MarkerTrajectories trial_;
  RowMatrix truth_;
};

TEST_F(IkSolverTest, ExactMarkersGiveTheMotionBack) {
  const IkResult result = solve();
  EXPECT_NEAR((result.coordinates.values - truth_).cwiseAbs().maxCoeff(), 0, tol(1e-8));
  EXPECT_NEAR(result.max_rms, 0, tol(1e-9));
  EXPECT_EQ(result.unconverged_frames, 0);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_GT(result.observability, 0);
}

TEST_F(IkSolverTest, ResultRowsAreLabelledInModelOrder) {
  const IkResult result = solve();
  EXPECT_EQ(result.coordinates.labels, model_.coordinateNames());
  EXPECT_EQ(result.coordinates.units[0], "rad");
  EXPECT_EQ(result.coordinates.units[3], "m");
  EXPECT_EQ(result.coordinates.time, trial_.time);
}

TEST_F(IkSolverTest, MarkersThatComeAndGoDoNotDisturb) {
  for (int frame = 10; frame < 20; ++frame) {
    for (const int marker : {0, 7, 22}) {
      trial_.positions.row(frame).segment<3>(3 * marker).setConstant(kNaN);
    }
  }
  const IkResult result = solve();
  EXPECT_NEAR((result.coordinates.values - truth_).cwiseAbs().maxCoeff(), 0, tol(1e-8));
  EXPECT_EQ(result.visible_counts[15], trial_.markerCount() - 3);
  EXPECT_TRUE(std::isnan(result.marker_errors.values(15, 7)));
}

TEST_F(IkSolverTest, FrameWithoutMarkersRepeatsThePoseAndIsReported) {
  trial_.positions.row(12).setConstant(kNaN);
  const IkResult result = solve();
  EXPECT_EQ(result.coordinates.values.row(12), result.coordinates.values.row(11));
  EXPECT_TRUE(std::isnan(result.errors.values(12, 1)));
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_NE(result.warnings[0].find("1 frames show no weighted marker"), std::string::npos);
}

TEST_F(IkSolverTest, WorstMarkerIsNamed) {
  const int marker = *trial_.findMarker("RTOE");
  for (int frame = 0; frame < kFrames; ++frame) {
    trial_.positions(frame, 3 * marker) += frame == 5 ? 0.5 : 0.0;
  }
  const IkResult result = solve();
  EXPECT_EQ(result.worst_markers[5], "RTOE");
  EXPECT_EQ(result.max_error_marker, "RTOE");
  EXPECT_GT(result.max_error, 0.04);
  EXPECT_FALSE(result.warnings.empty());
}

TEST_F(IkSolverTest, TimeRangeTakesTheNearestFrames) {
  options_.range = {0.104, 0.197};
  const IkResult result = solve();
  EXPECT_NEAR(result.coordinates.time.front(), 0.10, tol(1e-12));
  EXPECT_NEAR(result.coordinates.time.back(), 0.20, tol(1e-12));
}

TEST_F(IkSolverTest, RangeOutsideTheTrialIsRefused) {
  options_.range = {5, 6};
  try {
    solve();
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInputTimeRange);
  }
}

TEST_F(IkSolverTest, TwiceIsBitwiseTheSame) {
  EXPECT_EQ(solve().coordinates.values, solve().coordinates.values);
}

TEST_F(IkSolverTest, CancellationStopsTheTrial) {
  IkSolver solver(model_, options_, trial_.names);
  try {
    solver.solve(trial_, [](double fraction) { return fraction < 0.5; });
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCancelled);
  }
}

// Every evaluation allocates what Simbody's realization of a pose does, and nothing else.
TEST_F(IkSolverTest, FrameAllocatesNothingOfItsOwn) {
  IkSolver solver(model_, options_, trial_.names);
  Eigen::VectorXd q = makePose(0);
  const Eigen::VectorXd positions = measure(makePose(0.02));
  const Eigen::Matrix3Xd measured =
      Eigen::Map<const Eigen::Matrix3Xd>(positions.data(), 3, trial_.markerCount());
  solver.solveFrame(measured, q);
  q = makePose(0);
  ModelState state(model_);
  state.setPose(q);
  const long of_one_pose = countAllocationsOf([&] { state.setPose(q); });
  const long of_the_frame = countAllocationsOf([&] { solver.solveFrame(measured, q); });
  EXPECT_EQ(of_one_pose == 0 ? of_the_frame : of_the_frame % of_one_pose, 0);
}

// The mirror image of a motion has the mirrored coordinates.
TEST_F(IkSolverTest, MirroredMarkersGiveTheMirroredPose) {
  const auto mirrorName = [&](std::string name) {
    const std::string swapped = (name[0] == 'R' ? "L" : "R") + name.substr(1);
    return trial_.findMarker(swapped) ? swapped : name;
  };
  MarkerTrajectories mirrored = trial_;
  for (int marker = 0; marker < trial_.markerCount(); ++marker) {
    const int source =
        *trial_.findMarker(mirrorName(trial_.names[static_cast<std::size_t>(marker)]));
    mirrored.positions.middleCols(3 * marker, 3) = trial_.positions.middleCols(3 * source, 3);
    mirrored.positions.col(3 * marker + 2) *= -1;
  }
  // Only markers that are placed symmetrically on the model take part.
  for (MarkerWeight& task : options_.tasks.markers) {
    const auto find = [&](const std::string& name) {
      return model_.spec().markers[static_cast<std::size_t>(model_.spec().findMarker(name))];
    };
    const Eigen::Vector3d image =
        find(mirrorName(task.marker)).location.cwiseProduct(Eigen::Vector3d(1, 1, -1));
    task.weight = (find(task.marker).location - image).norm() < 1e-9 ? 1.0 : 0.0;
  }
  const IkResult plain = solve();
  const IkResult image = IkSolver(model_, options_, mirrored.names).solve(mirrored);
  for (const char* name : {"hip_flexion",
                           "hip_adduction",
                           "hip_rotation",
                           "knee_angle",
                           "ankle_angle",
                           "arm_flex",
                           "arm_add",
                           "arm_rot",
                           "elbow_flex"}) {
    const int r = plain.coordinates.getColumn(std::string(name) + "_r");
    const int l = plain.coordinates.getColumn(std::string(name) + "_l");
    EXPECT_NEAR(
        (plain.coordinates.values.col(r) - image.coordinates.values.col(l)).cwiseAbs().maxCoeff(),
        0,
        tol(1e-7))
        << name;
  }
}

}  // namespace
}  // namespace gaitmill

#include "core/model/marker_fit.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/io/files.h"
#include "core/io/osim_reader.h"
#include "core/model/pose_search.h"
#include "tests/support/shared_data.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// The generic model with its own 66 markers, all of weight 1, and random poses inside the ranges.
class MarkerFitTest : public SharedDataTest {
 protected:
  void SetUp() override {
    SharedDataTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) {
      return;
    }
    const std::string path = shared("data/models/Rajagopal2016.osim");
    model_ = std::make_unique<Model>(readOsim(readFile(path), path));
    free_ = std::make_unique<FreeCoordinates>(*model_);
    for (const MarkerSpec& marker : model_->spec().markers) {
      tasks_.markers.push_back({marker.name, 1.0});
      names_.push_back(marker.name);
    }
  }

  Eigen::VectorXd makePose(std::mt19937& random, double share) const {
    std::uniform_real_distribution<double> uniform(-1, 1);
    Eigen::VectorXd q = model_->defaultPose();
    for (const CoordinateIndex c : free_->indices()) {
      const CoordinateSpec& spec = model_->coordinate(c);
      const double middle = 0.5 * (spec.range_min + spec.range_max);
      q[c.value()] = middle + share * 0.5 * (spec.range_max - spec.range_min) * uniform(random);
    }
    free_->conformPose(q);
    return q;
  }

  Eigen::Matrix3Xd measure(const Eigen::VectorXd& q, const std::vector<std::string>& names) const {
    ModelState state(*model_);
    state.setPose(q);
    Eigen::Matrix3Xd measured(3, static_cast<Eigen::Index>(names.size()));
    for (std::size_t i = 0; i < names.size(); ++i) {
      const MarkerSpec& marker =
          model_->spec().markers[static_cast<std::size_t>(model_->spec().findMarker(names[i]))];
      measured.col(static_cast<Eigen::Index>(i)) =
          state.pose(model_->getBody(marker.body)) * marker.location;
    }
    return measured;
  }

  /// Millimetres of noise, the same for the same seed.
  Eigen::Matrix3Xd addNoise(Eigen::Matrix3Xd measured, double sigma, unsigned seed) const {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, sigma);
    return measured.unaryExpr([&](double x) { return x + normal(random); });
  }

  std::unique_ptr<Model> model_;
  std::unique_ptr<FreeCoordinates> free_;
  FitTasks tasks_;
  std::vector<std::string> names_;
};

TEST_F(MarkerFitTest, ExactMarkersGiveThePoseBack) {
  MarkerFit fit(*model_, tasks_, names_);
  std::mt19937 random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::VectorXd q = makePose(random, 0.5);
    const Eigen::VectorXd nudge = makePose(random, 0.05) - makePose(random, 0.05);
    Eigen::VectorXd found = q + nudge;
    const MarkerFitSummary summary = fit.solve(measure(q, fit.markers()), found);
    EXPECT_EQ(summary.stop, FitStop::kConverged);
    EXPECT_NEAR((found - q).lpNorm<Eigen::Infinity>(), 0.0, tol(1e-9)) << trial;
  }
}

TEST_F(MarkerFitTest, AnswerDoesNotDependOnTheStart) {
  MarkerFit fit(*model_, tasks_, names_);
  std::mt19937 random(2);
  for (unsigned trial = 0; trial < 10; ++trial) {
    const Eigen::VectorXd q = makePose(random, 0.4);
    const Eigen::Matrix3Xd measured = addNoise(measure(q, fit.markers()), 0.005, trial);
    Eigen::VectorXd a = q + 0.2 * (makePose(random, 0.3) - makePose(random, 0.3));
    Eigen::VectorXd b = q;
    fit.solve(measured, a);
    fit.solve(measured, b);
    EXPECT_NEAR((a - b).lpNorm<Eigen::Infinity>(), 0.0, tol(1e-7)) << trial;
  }
}

// With noise, nothing near the answer is better: the gradient vanishes off the bounds.
TEST_F(MarkerFitTest, AnswerIsAMinimum) {
  MarkerFit fit(*model_, tasks_, names_);
  std::mt19937 random(3);
  const Eigen::VectorXd q = makePose(random, 0.4);
  const Eigen::Matrix3Xd measured = addNoise(measure(q, fit.markers()), 0.01, 7);
  Eigen::VectorXd best = q;
  fit.solve(measured, best);
  const auto objective = [&](const Eigen::VectorXd& pose) {
    return (measure(pose, fit.markers()) - measured).squaredNorm();
  };
  for (const CoordinateIndex c : free_->indices()) {
    const double h = 1e-4;
    Eigen::VectorXd plus = best;
    Eigen::VectorXd minus = best;
    plus[c.value()] += h;
    minus[c.value()] -= h;
    free_->conformPose(plus);
    free_->conformPose(minus);
    const double slope = (objective(plus) - objective(minus)) / (2 * h);
    const CoordinateSpec& spec = model_->coordinate(c);
    if (best[c.value()] > spec.range_min && best[c.value()] < spec.range_max) {
      EXPECT_NEAR(slope, 0.0, tol(1e-7)) << spec.name;
    }
  }
}

TEST_F(MarkerFitTest, ClampedCoordinateStopsExactlyAtItsBound) {
  FitTasks tasks = tasks_;
  tasks.ranges.push_back({"knee_angle_r", 0.3, 2.0});
  MarkerFit fit(*model_, tasks, names_);
  Eigen::VectorXd q = model_->defaultPose();
  q[model_->getCoordinate("elbow_flex_r").value()] = 0.2;
  const Eigen::Matrix3Xd measured = measure(q, fit.markers());
  fit.solve(measured, q);
  EXPECT_EQ(q[model_->getCoordinate("knee_angle_r").value()], 0.3);
  EXPECT_EQ(q[model_->getCoordinate("knee_angle_r_beta").value()], 0.3);
  EXPECT_EQ(q[model_->getCoordinate("subtalar_angle_r").value()], 0.0);
}

TEST_F(MarkerFitTest, MissingMarkerDoesNotPull) {
  MarkerFit fit(*model_, tasks_, names_);
  std::mt19937 random(4);
  const Eigen::VectorXd q = makePose(random, 0.4);
  Eigen::Matrix3Xd measured = measure(q, fit.markers());
  measured.col(3).setConstant(kNaN);
  measured(1, 10) = kNaN;
  Eigen::VectorXd found = q;
  fit.solve(measured, found);
  EXPECT_NEAR((found - q).lpNorm<Eigen::Infinity>(), 0.0, tol(1e-9));
  EXPECT_TRUE(std::isnan(fit.errors()[3]));
  EXPECT_TRUE(std::isnan(fit.errors()[10]));
}

TEST_F(MarkerFitTest, CoordinateTaskPullsAgainstMarkers) {
  FitTasks tasks = tasks_;
  tasks.coordinates.push_back({"hip_flexion_r", 1e6, 0.25});
  MarkerFit fit(*model_, tasks, names_);
  Eigen::VectorXd q = model_->defaultPose();
  const Eigen::Matrix3Xd measured = measure(q, fit.markers());
  fit.solve(measured, q);
  EXPECT_NEAR(q[model_->getCoordinate("hip_flexion_r").value()], 0.25, tol(1e-5));
}

TEST_F(MarkerFitTest, UnobservedCoordinateIsHeldAndNamed) {
  FitTasks tasks;
  for (const char* name : {"RASI", "LASI", "RPSI", "LPSI"}) {
    tasks.markers.push_back({name, 1.0});
  }
  MarkerFit fit(*model_, tasks, names_);
  EXPECT_EQ(fit.heldCoordinates().size(), static_cast<std::size_t>(free_->count() - 6));
  Eigen::VectorXd q = model_->defaultPose();
  q[model_->getCoordinate("hip_flexion_r").value()] = 0.4;
  q[model_->getCoordinate("pelvis_ty").value()] = 0.9;
  fit.solve(measure(model_->defaultPose(), fit.markers()), q);
  EXPECT_EQ(q[model_->getCoordinate("hip_flexion_r").value()], 0.4);
  EXPECT_NEAR(q[model_->getCoordinate("pelvis_ty").value()], 0.94, tol(1e-9));
}

TEST_F(MarkerFitTest, MarkersOfAnotherLaboratoryAreRefused) {
  try {
    MarkerFit fit(*model_, tasks_, {"R.ASIS", "L.ASIS"});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInputMarkers);
  }
}

// Arms raised sideways and a heading of -90 degrees: a start from the default pose ends in a trap.
TEST_F(MarkerFitTest, SearchFindsPosesFarFromTheDefault) {
  MarkerFit fit(*model_, tasks_, names_);
  PoseSearch search(*model_, fit);
  std::mt19937 random(5);
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::VectorXd q = makePose(random, 0.3);
    const auto set = [&](const char* name, double value) {
      q[model_->getCoordinate(name).value()] += value;
    };
    set("pelvis_rotation", trial % 2 == 0 ? -1.0 : 1.0);
    set("arm_add_r", -1.2);
    set("arm_add_l", -1.0);
    Eigen::VectorXd found(model_->coordinateCount());
    const MarkerFitSummary summary = search.solve(measure(q, fit.markers()), found);
    EXPECT_EQ(summary.stop, FitStop::kConverged);
    EXPECT_NEAR(summary.objective, 0.0, tol(1e-15)) << trial;
    EXPECT_NEAR((found - q).lpNorm<Eigen::Infinity>(), 0.0, tol(1e-7)) << trial;
  }
}

}  // namespace
}  // namespace gaitmill

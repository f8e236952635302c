#include "core/scale/motion_fit_program.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "core/model/model.h"
#include "core/scale/apply_scale.h"
#include "core/scale/stretched_markers.h"
#include "tests/support/model_files.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Eigen::VectorXd makeSizes(std::mt19937& random, std::size_t count) {
  std::uniform_real_distribution<double> uniform(0.8, 1.25);
  Eigen::VectorXd sizes(static_cast<Eigen::Index>(count));
  for (double& size : sizes) {
    size = uniform(random);
  }
  return sizes;
}

/// A pose in the middle half of every range.
Eigen::VectorXd makePose(std::mt19937& random, const Model& model) {
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  Eigen::VectorXd q = model.defaultPose();
  const FreeCoordinates free(model);
  for (const CoordinateIndex c : free.indices()) {
    const CoordinateSpec& spec = model.coordinate(c);
    const double half = 0.5 * (spec.range_max - spec.range_min);
    q[c.value()] = 0.5 * (spec.range_max + spec.range_min) + half * uniform(random);
  }
  free.conformPose(q);
  return q;
}

std::vector<std::string> findMarkerNames(const ModelSpec& model) {
  std::vector<std::string> names;
  for (const MarkerSpec& marker : model.markers) {
    names.push_back(marker.name);
  }
  return names;
}

// Two ways to one position: the sum of the parts, and the model that scaling makes.
TEST(StretchedMarkers, AreWhereTheScaledModelHasThem) {
  const ModelSpec generic = makeKinematicModel(readOwnModel());
  const std::vector<ScaleGroup> groups = makeScaleGroups(generic);
  const std::vector<std::string> names = findMarkerNames(generic);
  StretchedMarkers markers(generic, groups, names);
  std::mt19937 random(5);
  for (int trial = 0; trial < 5; ++trial) {
    const Eigen::VectorXd sizes = makeSizes(random, groups.size());
    const Model scaled(applyScaleFactors(
        generic, calcBodyScales(generic, groups, sizes), MassDistribution::kPreserved));
    const Eigen::VectorXd q = makePose(random, scaled);
    ModelState state(scaled);
    state.setPose(q);
    markers.setPose(q);
    for (int m = 0; m < markers.markerCount(); ++m) {
      const MarkerSpec& marker = scaled.spec().markers[static_cast<std::size_t>(m)];
      Eigen::Vector3d position = markers.base(m);
      for (const int g : markers.groups(m)) {
        position += sizes[g] * markers.column(g, m);
      }
      const Eigen::Vector3d expected = state.pose(scaled.getBody(marker.body)) * marker.location;
      EXPECT_LT((position - expected).norm(), tol(1e-13)) << marker.name;
    }
  }
}

/// Three frames of random markers, so that residuals are large and every second derivative counts.
class MotionFitProgramTest : public ::testing::Test {
 protected:
  void SetUp() override {
    generic_ = makeKinematicModel(readOwnModel());
    const Model model(generic_);
    const FreeCoordinates free(model);
    data_.groups = makeScaleGroups(generic_);
    data_.markers = findMarkerNames(generic_);
    const auto n = static_cast<Eigen::Index>(data_.groups.size());
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (std::size_t m = 0; m < data_.markers.size(); ++m) {
      data_.offset_deviations.push_back(m % 3 == 0 ? 0.0 : 0.1);
      data_.weights.push_back(1.0 + 0.1 * static_cast<double>(m));
    }
    for (int k = 0; k < 3; ++k) {
      data_.measured.emplace_back(Eigen::Matrix3Xd::NullaryExpr(
          3, static_cast<Eigen::Index>(data_.markers.size()), [&] { return uniform(random_); }));
      data_.measured.back().col(7 + k).setConstant(kNaN);
    }
    data_.size_priors = {{"first", {0}, {1.0}, 1.1, 0.2}, {"pair", {2, 5}, {1.0, -0.5}, 0.1, 0.3}};
    data_.size_lower.setConstant(n, 0.5);
    data_.size_upper.setConstant(n, 2.0);
    data_.pose_lower.setConstant(free.count(), -10);
    data_.pose_upper.setConstant(free.count(), 10);
    data_.pose_mean.setConstant(free.count(), 0.1);
    data_.pose_weights.setConstant(free.count(), 0.3);
    program_ = std::make_unique<MotionFitProgram>(generic_, data_);
    x_.setZero(program_->variableCount());
    x_.head(n) = makeSizes(random_, data_.groups.size());
    for (Eigen::Index i = n; i < program_->poseStart(0); ++i) {
      x_[i] = 0.1 * uniform(random_);
    }
    for (int k = 0; k < 3; ++k) {
      free.pick(makePose(random_, model), x_.segment(program_->poseStart(k), free.count()));
    }
  }

  Eigen::VectorXd calcGradient(const Eigen::VectorXd& x) const {
    Eigen::VectorXd gradient(x.size());
    program_->calcGradient(x, gradient);
    return gradient;
  }

  Eigen::MatrixXd calcHessian(const Eigen::VectorXd& x) const {
    const std::vector<SparseEntry> pattern = program_->hessianPattern();
    Eigen::VectorXd values(static_cast<Eigen::Index>(pattern.size()));
    program_->calcHessian(x, 1.0, Eigen::VectorXd(), values);
    Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(x.size(), x.size());
    for (std::size_t i = 0; i < pattern.size(); ++i) {
      EXPECT_EQ(hessian(pattern[i].row, pattern[i].column), 0) << "an entry is stored twice";
      EXPECT_GE(pattern[i].row, pattern[i].column);
      hessian(pattern[i].row, pattern[i].column) = values[static_cast<Eigen::Index>(i)];
      hessian(pattern[i].column, pattern[i].row) = values[static_cast<Eigen::Index>(i)];
    }
    return hessian;
  }

  std::mt19937 random_{11};
  ModelSpec generic_;
  MotionFitData data_;
  std::unique_ptr<MotionFitProgram> program_;
  Eigen::VectorXd x_;
};

// Central differences over 1e-5 of an objective of some hundred: round-off 1e-8, truncation less.
TEST_F(MotionFitProgramTest, GradientIsTheSlopeOfTheObjective) {
  constexpr double kStep = 1e-5;
  const Eigen::VectorXd gradient = calcGradient(x_);
  for (Eigen::Index i = 0; i < x_.size(); ++i) {
    Eigen::VectorXd up = x_;
    Eigen::VectorXd down = x_;
    up[i] += kStep;
    down[i] -= kStep;
    const double slope =
        (program_->calcObjective(up) - program_->calcObjective(down)) / (2 * kStep);
    EXPECT_NEAR(gradient[i], slope, tol(1e-5 * std::max(1.0, std::abs(slope)))) << "unknown " << i;
  }
}

// All but the knees with themselves, whose splines bend: only there the Hessian is not exact.
TEST_F(MotionFitProgramTest, HessianIsTheSlopeOfTheGradient) {
  constexpr double kStep = 1e-6;
  const Eigen::MatrixXd hessian = calcHessian(x_);
  const Model model(generic_);
  const FreeCoordinates free(model);
  const auto isKnee = [&](Eigen::Index i) {
    const Eigen::Index f = (i - program_->poseStart(0)) % free.count();
    return i >= program_->poseStart(0) &&
           model.coordinate(free.indices()[static_cast<std::size_t>(f)]).name.find("knee") == 0;
  };
  int knees = 0;
  for (Eigen::Index i = 0; i < x_.size(); ++i) {
    Eigen::VectorXd up = x_;
    Eigen::VectorXd down = x_;
    up[i] += kStep;
    down[i] -= kStep;
    Eigen::VectorXd slope = (calcGradient(up) - calcGradient(down)) / (2 * kStep);
    if (isKnee(i)) {
      slope[i] = hessian(i, i);
      ++knees;
    }
    EXPECT_LT((hessian.col(i) - slope).lpNorm<Eigen::Infinity>(),
              tol(1e-6 * std::max(1.0, slope.lpNorm<Eigen::Infinity>())))
        << "unknown " << i;
  }
  EXPECT_EQ(knees, 6);
}

TEST_F(MotionFitProgramTest, ErrorsAreThoseOfTheObjective) {
  const Eigen::MatrixXd errors = program_->calcErrors(x_);
  EXPECT_TRUE(std::isnan(errors(0, 7)));
  EXPECT_TRUE(std::isnan(errors(2, 9)));
  double total = 0;
  for (Eigen::Index k = 0; k < errors.rows(); ++k) {
    for (Eigen::Index m = 0; m < errors.cols(); ++m) {
      const double w = data_.weights[static_cast<std::size_t>(m)];
      total += std::isnan(errors(k, m)) ? 0 : 0.5 * w * errors(k, m) * errors(k, m);
    }
  }
  data_.size_priors.clear();
  data_.pose_weights.setZero();
  for (double& deviation : data_.offset_deviations) {
    deviation = deviation > 0 ? 1e9 : 0;
  }
  EXPECT_NEAR(program_->calcObjective(x_), total, tol(1e-10 * total));
}

}  // namespace
}  // namespace gaitmill

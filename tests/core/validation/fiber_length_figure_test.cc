#include "core/validation/fiber_length_figure.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/sample/gait_pattern.h"
#include "core/validation/posed_muscles.h"
#include "core/validation/validation.h"
#include "tests/support/model_files.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

const Figure& ownFigure() {
  static const Figure figure = makeFiberLengthFigure(readOwnModel());
  return figure;
}

const Series& findSeries(const std::string& name) {
  for (const Panel& panel : ownFigure().panels) {
    for (const Series& series : panel.series) {
      if (series.name == name) {
        return series;
      }
    }
  }
  ADD_FAILURE() << name;
  return ownFigure().panels.front().series.front();
}

TEST(FiberLengthFigure, HasTheFortyMusclesOfTheRightLegOverOneClosedCycle) {
  std::size_t count = 0;
  for (const Panel& panel : ownFigure().panels) {
    for (const Series& series : panel.series) {
      ++count;
      ASSERT_EQ(series.x.size(), 101u);
      EXPECT_EQ(series.x.front(), 0);
      EXPECT_EQ(series.x.back(), 100);
      EXPECT_NEAR(series.y.front(), series.y.back(), tol(1e-9)) << series.name;
    }
  }
  EXPECT_EQ(count, 40u);
}

// A rigid tendon leaves the fiber what the path is longer: l = hypot(h, L - lsT).
TEST(FiberLengthFigure, FibersFollowThePathsOfTheWalkingPattern) {
  const ModelSpec model = readOwnModel();
  PosedMuscles posed(model);
  const GaitPattern pattern;
  const GaitMotion motion(posed.model(), pattern);
  Eigen::VectorXd q(posed.model().coordinateCount());
  Eigen::VectorXd u(q.size());
  Eigen::VectorXd udot(q.size());
  motion.calc(0.4 * pattern.period, q, u, udot);
  posed.setPose(Eigen::VectorXd(q));
  const int m = model.findMuscle("psoas_r");
  const MuscleSpec& psoas = model.muscles[static_cast<std::size_t>(m)];
  const double length =
      std::hypot(psoas.optimal_fiber_length * std::sin(psoas.pennation_at_optimal),
                 posed.findLength(MuscleIndex(m)) - psoas.tendon_slack_length);
  EXPECT_NEAR(findSeries("Psoas").y[40], length / psoas.optimal_fiber_length, tol(1e-12));
}

// Elastic: the balance at 1 % activation holds for the length shown.
TEST(FiberLengthFigure, ElasticMusclesAreInEquilibrium) {
  const ModelSpec model = readOwnModel();
  PosedMuscles posed(model);
  const GaitPattern pattern;
  const GaitMotion motion(posed.model(), pattern);
  Eigen::VectorXd q(posed.model().coordinateCount());
  Eigen::VectorXd u(q.size());
  Eigen::VectorXd udot(q.size());
  motion.calc(0.55 * pattern.period, q, u, udot);
  posed.setPose(Eigen::VectorXd(q));
  const int m = model.findMuscle("gasmed_r");
  const Muscle& gasmed = posed.muscle(MuscleIndex(m));
  const double length = findSeries("Gastrocnemius, medial").y[55] * gasmed.optimalFiberLength();
  const FiberState state = gasmed.calcElastic(0.01, length, posed.findLength(MuscleIndex(m)));
  EXPECT_NEAR(state.norm_velocity, 0, tol(1e-9));
}

TEST(FiberLengthFigure, NeedsTheCoordinatesOfThePattern) {
  ModelSpec model = readOwnModel();
  EXPECT_TRUE(hasFiberLengthFigure(model));
  for (MuscleSpec& muscle : model.muscles) {
    muscle.name = "right " + muscle.name.substr(0, muscle.name.size() - 2);
  }
  EXPECT_FALSE(hasFiberLengthFigure(model));
  EXPECT_FALSE(hasFiberLengthFigure(ModelSpec{}));
}

}  // namespace
}  // namespace gaitmill

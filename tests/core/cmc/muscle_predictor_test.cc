#include "core/cmc/muscle_predictor.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/allocation_counter.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

// Soleus, with an elastic tendon, and psoas, with a rigid one, of Rajagopal2016; vmax as in the
// published simulations.
std::vector<MuscleSpec> makeSpecs() {
  MuscleSpec soleus;
  soleus.name = "soleus_r";
  soleus.max_isometric_force = 6195;
  soleus.optimal_fiber_length = 0.044;
  soleus.tendon_slack_length = 0.27676;
  soleus.pennation_at_optimal = 0.38143;
  soleus.max_contraction_velocity = 15;
  MuscleSpec psoas = soleus;
  psoas.name = "psoas_r";
  psoas.max_isometric_force = 1427;
  psoas.optimal_fiber_length = 0.1169;
  psoas.tendon_slack_length = 0.09954;
  psoas.pennation_at_optimal = 0.21552;
  psoas.tendon = TendonKind::kRigid;
  return {soleus, psoas};
}

double pathLength(double t) {
  return 0.322 + 0.1 * t - 5 * t * t;
}
double pathSpeed(double t) {
  return 0.1 - 10 * t;
}

class MusclePredictorTest : public ::testing::Test {
 protected:
  MusclePredictorTest() : muscles_(makeMuscles(makeSpecs())), predictor_(muscles_, 2, 1e-8) {
    predictor_.paths().start(kDuration / 2, 2);
    for (int k = 0; k <= 2; ++k) {
      const double t = kDuration / 2 * k;
      predictor_.paths().setNode(
          k, Eigen::Vector2d(pathLength(t), 0.22), Eigen::Vector2d(pathSpeed(t), 0));
    }
    predictor_.setEnd(kDuration,
                      Eigen::Vector2d(pathLength(kDuration), 0.22),
                      Eigen::Vector2d(pathSpeed(kDuration), -0.2));
  }

  static constexpr double kDuration = 0.010;
  std::vector<Muscle> muscles_;
  MusclePredictor predictor_;
};

// Runge-Kutta with steps of 0.2 us on dl/dt = v(a(t), l, L(t)).
TEST_F(MusclePredictorTest, ElasticTendonMatchesTinyExplicitSteps) {
  const Muscle& soleus = muscles_[0];
  for (const double x : {0.02, 0.3, 1.0}) {
    const auto rate = [&](double t, double l) {
      const double a = soleus.activationDynamics().propagate(0.2, x, t);
      return soleus.calcElastic(a, l, pathLength(t)).velocity;
    };
    double l = 0.046;
    const int steps = 5000;
    const double h = kDuration / steps;
    for (int i = 0; i < steps; ++i) {
      const double t = h * i;
      const double k1 = rate(t, l);
      const double k2 = rate(t + h / 2, l + h / 2 * k1);
      const double k3 = rate(t + h / 2, l + h / 2 * k2);
      const double k4 = rate(t + h, l + h * k3);
      l += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    const MusclePrediction end = predictor_.predict(0, {0.2, 0.046}, x);
    EXPECT_NEAR(end.fiber_length, l, tol(1e-8 * 0.044 * 10)) << x;
    EXPECT_NEAR(end.tendon_force, soleus.calcTendonForce(l, pathLength(kDuration)), tol(0.01));
  }
}

TEST_F(MusclePredictorTest, RigidTendonIsExplicitInTheFinalActivation) {
  const MusclePrediction end = predictor_.predict(1, {0.2, 0}, 0.7);
  EXPECT_EQ(end.activation, muscles_[1].activationDynamics().propagate(0.2, 0.7, kDuration));
  EXPECT_NEAR(
      end.tendon_force, muscles_[1].calcRigid(end.activation, 0.22, -0.2).tendon_force, tol(1e-9));
}

TEST_F(MusclePredictorTest, FindsTheExcitationBackFromTheForce) {
  for (int muscle = 0; muscle < 2; ++muscle) {
    const MusclePredictor::Start start = {0.2, 0.046};
    const MusclePredictor::Range range = {0.02,
                                          1,
                                          predictor_.predict(muscle, start, 0.02).tendon_force,
                                          predictor_.predict(muscle, start, 1).tendon_force};
    for (const double x : {0.02, 0.021, 0.1, 0.19, 0.21, 0.6, 0.99, 1.0}) {
      const double force = predictor_.predict(muscle, start, x).tendon_force;
      EXPECT_NEAR(predictor_.findExcitation(muscle, start, range, force, 1e-6), x, tol(1e-6));
    }
    EXPECT_EQ(predictor_.findExcitation(muscle, start, range, -1, 1e-6), 0.02);
    EXPECT_EQ(predictor_.findExcitation(muscle, start, range, 1e5, 1e-6), 1);
  }
}

// A tendon stretched by half its length, as at the start of the initial stage: the fiber shoots
// back and settles at rest.
TEST_F(MusclePredictorTest, SettlesFromAGrosslyOverstretchedTendon) {
  const double path = 0.33;
  predictor_.paths().start(0.4, 1);
  for (int k = 0; k <= 1; ++k) {
    predictor_.paths().setNode(k, Eigen::Vector2d(path, 0.22), Eigen::Vector2d::Zero());
  }
  predictor_.setEnd(0.4, Eigen::Vector2d(path, 0.22), Eigen::Vector2d::Zero());
  for (const double start : {0.02, 0.2}) {
    const MusclePrediction end = predictor_.predict(0, {0.05, start}, 0.05);
    EXPECT_NEAR(end.fiber_length, muscles_[0].solveStaticLength(0.05, path), tol(1e-5));
  }
}

TEST_F(MusclePredictorTest, DoesNotAllocate) {
  EXPECT_EQ(countAllocationsOf([&] {
              for (int muscle = 0; muscle < 2; ++muscle) {
                predictor_.predict(muscle, {0.2, 0.046}, 0.5);
              }
            }),
            0);
}

}  // namespace
}  // namespace gaitmill

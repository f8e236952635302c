#include "core/muscle/activation_dynamics.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

// Fourth-order Runge-Kutta with steps far below the time constants.
double integrate(const ActivationDynamics& dynamics, double a, double x, double duration) {
  const int steps = 4000;
  const double h = duration / steps;
  for (int i = 0; i < steps; ++i) {
    const double k1 = dynamics.calcRate(a, x);
    const double k2 = dynamics.calcRate(a + 0.5 * h * k1, x);
    const double k3 = dynamics.calcRate(a + 0.5 * h * k2, x);
    const double k4 = dynamics.calcRate(a + h * k3, x);
    a += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return a;
}

// spec/muscle.md 5, printed to ten digits.
TEST(ActivationDynamics, RateMatchesTheCheckValues) {
  const ActivationDynamics dynamics;
  EXPECT_NEAR(dynamics.calcRate(0.3, 0.8), 52.63157895, tol(5e-9));
  EXPECT_NEAR(dynamics.calcRate(0.3, 0.1), -4.75, tol(1e-14));
  EXPECT_NEAR(dynamics.calcRate(1, 0.5), -25, tol(1e-14));
  EXPECT_NEAR(dynamics.calcRate(0.01, 1), 192.2330097, tol(5e-8));
}

TEST(ActivationDynamics, PropagationIsTheSolutionOfTheRateEquation) {
  const ActivationDynamics dynamics;
  for (const double a : {0.01, 0.02, 0.3, 0.7, 1.0}) {
    for (const double x : {0.0, 0.01, 0.02, 0.05, 0.3, 0.5, 1.0}) {
      for (const double duration : {1e-4, 2.5e-3, 0.01, 0.03, 0.2}) {
        EXPECT_NEAR(
            dynamics.propagate(a, x, duration), integrate(dynamics, a, x, duration), tol(1e-12))
            << a << " towards " << x << " for " << duration;
      }
    }
  }
}

TEST(ActivationDynamics, NeverPassesTheExcitation) {
  const ActivationDynamics dynamics;
  EXPECT_EQ(dynamics.propagate(0.3, 0.3, 0.01), 0.3);
  EXPECT_LE(dynamics.propagate(0.01, 0.9, 100), 0.9);
  EXPECT_GE(dynamics.propagate(0.9, 0.01, 100), 0.01 - 1e-15);
}

}  // namespace
}  // namespace gaitmill

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

ActivationDynamics makeSchutteDynamics() {
  ActivationDynamics dynamics;
  dynamics.law = ActivationDynamics::Law::kSchutte1993;
  dynamics.excitation_rate = 76.67;
  dynamics.activation_rate = 14.59854;
  return dynamics;
}

// OpenSim's default constants: (x - a)(76.67 x + 14.59854) rising, (x - a) 14.59854 falling.
TEST(SchutteActivation, RateIsThePublishedOne) {
  const ActivationDynamics dynamics = makeSchutteDynamics();
  EXPECT_NEAR(dynamics.calcRate(0.3, 0.8), 0.5 * (76.67 * 0.8 + 14.59854), tol(1e-12));
  EXPECT_NEAR(dynamics.calcRate(0.3, 0.1), -0.2 * 14.59854, tol(1e-13));
  EXPECT_EQ(dynamics.calcRate(0.3, 0.3), 0);
}

TEST(SchutteActivation, PropagationSolvesTheRate) {
  const ActivationDynamics dynamics = makeSchutteDynamics();
  constexpr double h = 1e-6;
  for (const double x : {0.05, 0.4, 1.0}) {
    for (const double t : {0.0, 0.004, 0.03}) {
      const double a = dynamics.propagate(0.2, x, t);
      const double slope =
          (dynamics.propagate(0.2, x, t + h) - dynamics.propagate(0.2, x, t - h)) / (2 * h);
      EXPECT_NEAR(slope, dynamics.calcRate(a, x), tol(1e-6));
    }
    EXPECT_NEAR(dynamics.propagate(0.2, x, 10), x, tol(1e-12));
  }
}

// The distributed Arnold model states zero for both: its activation cannot change.
TEST(SchutteActivation, WithoutRatesActivationStays) {
  ActivationDynamics dynamics = makeSchutteDynamics();
  dynamics.excitation_rate = 0;
  dynamics.activation_rate = 0;
  EXPECT_NEAR(dynamics.propagate(0.2, 0.9, 1), 0.2, tol(1e-15));
}

}  // namespace
}  // namespace gaitmill

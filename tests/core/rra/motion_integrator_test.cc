#include "core/rra/motion_integrator.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/tolerance.h"

namespace gaitmill {
namespace {

// A bob on a massless rod with a torque at the pin.
struct Pendulum {
  Model model{makeSpec()};
  FreeCoordinates free{model};
  ExternalLoads loads{model, {}};
  ActuatedBody body{model, free, loads, {makeMotor()}};

  static ModelSpec makeSpec() {
    ModelSpec spec;
    spec.bodies = {{"bob", 2.0, {0, -0.4, 0}, {0, 0, 0, 0, 0, 0}, {}}};
    JointSpec pin;
    pin.name = "pin";
    pin.kind = JointSpec::Kind::kPin;
    pin.parent.body = "ground";
    pin.child.body = "bob";
    pin.coordinates = {{"angle"}};
    spec.joints = {pin};
    return spec;
  }

  static ActuatorSpec makeMotor() {
    ActuatorSpec motor;
    motor.name = "motor";
    motor.coordinate = "angle";
    motor.optimal_force = 10;
    return motor;
  }

  static MotionIntegrator::Ramp makeRamp(double start, double end, double from, double to) {
    return {start, end, Eigen::VectorXd::Constant(1, from), Eigen::VectorXd::Constant(1, to)};
  }

  static MotionState makeState(double q, double u) {
    return {0, Eigen::VectorXd::Constant(1, q), Eigen::VectorXd::Constant(1, u)};
  }
};

TEST(MotionIntegrator, SwingingPendulumKeepsItsEnergy) {
  Pendulum p;
  MotionIntegrator integrator(p.body, 1e-10);
  MotionState state = Pendulum::makeState(1.2, 0);
  const auto energy = [&] {
    return 0.5 * std::pow(0.4 * state.u(0), 2) - kGravity * 0.4 * std::cos(state.q(0));
  };
  const double before = energy();
  for (int i = 1; i <= 100; ++i) {
    const double end = 0.02 * i;
    integrator.advance(Pendulum::makeRamp(state.time, end, 0, 0), end, state);
  }
  EXPECT_EQ(state.time, 2.0);
  EXPECT_NEAR(energy(), before, tol(1e-6));
}

// Without gravity's lever (hanging still) a ramp of torque gives a cubic angle: 10 N.m/s over
// m l^2 = 0.32.
TEST(MotionIntegrator, ControlsRampBetweenTheirNodes) {
  ModelSpec spec = Pendulum::makeSpec();
  spec.gravity.setZero();
  const Model model(spec);
  const FreeCoordinates free(model);
  const ExternalLoads loads(model, {});
  ActuatedBody body(model, free, loads, {Pendulum::makeMotor()});
  MotionIntegrator integrator(body, 1e-10);
  MotionState state = Pendulum::makeState(0, 0);
  integrator.advance(Pendulum::makeRamp(0, 0.1, 0, 0.1), 0.1, state);
  EXPECT_NEAR(state.q(0), 10 * std::pow(0.1, 3) / 6 / 0.32, tol(1e-12));
  EXPECT_NEAR(state.u(0), 10 * std::pow(0.1, 2) / 2 / 0.32, tol(1e-12));
}

TEST(MotionIntegrator, TakesShorterStepsWhereTheErrorAsksForThem) {
  Pendulum p;
  MotionIntegrator coarse(p.body, 1e3);
  MotionIntegrator fine(p.body, 1e-9);
  MotionState state = Pendulum::makeState(1.2, 3);
  MotionState same = state;
  EXPECT_EQ(coarse.advance(Pendulum::makeRamp(0, 0.2, 0, 0), 0.2, state).steps, 1);
  EXPECT_GT(fine.advance(Pendulum::makeRamp(0, 0.2, 0, 0), 0.2, same).steps, 4);
}

// Simbody's function-based joints allocate whenever a pose is realized; nothing else does.
TEST(MotionIntegrator, AllocatesNothingBesidesSimbody) {
  Pendulum p;
  MotionIntegrator integrator(p.body, 1e3);
  MotionState state = Pendulum::makeState(1.2, 3);
  const auto ramp = Pendulum::makeRamp(0, 0.2, 0, 0);
  integrator.advance(ramp, 0.1, state);
  const Eigen::VectorXd q = state.q;
  const long stage = countAllocationsOf([&] { p.body.setMotion(0.1, q, state.u); });
  EXPECT_EQ(countAllocationsOf([&] { integrator.advance(ramp, 0.2, state); }), 5 * stage);
}

}  // namespace
}  // namespace gaitmill

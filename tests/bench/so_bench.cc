// Static optimization per row: the project's model in steps of a walking-like motion, residuals and
// reserves at every free coordinate, each row warm-started from the one before.
#include <cmath>

#include <benchmark/benchmark.h>

#include "core/so/so_solver.h"
#include "tests/support/model_files.h"

namespace gaitmill {
namespace {

struct Bench {
  Model model{readOwnModel()};
  FreeCoordinates free{model};
  ExternalLoads loads{model, {}};
  SoOptions options;
  Eigen::VectorXd q{free.count()}, u{free.count()}, u_dot{free.count()};

  Bench() {
    for (const CoordinateIndex c : free.indices()) {
      ActuatorSpec actuator;
      actuator.name = model.coordinate(c).name + "_reserve";
      actuator.coordinate = model.coordinate(c).name;
      actuator.optimal_force = c.value() < 6 ? 100 : 5;
      options.actuators.push_back(actuator);
    }
  }

  /// Hips, knees and ankles swing once per second.
  void setMotion(double t) {
    free.pick(model.defaultPose(), q);
    u.setZero();
    u_dot.setZero();
    const double w = 6.28;
    const auto swing = [&](const char* name, double middle, double range, double phase) {
      const int f = free.findFree(model.getCoordinate(name));
      q[f] = middle + range * std::sin(w * t + phase);
      u[f] = range * w * std::cos(w * t + phase);
      u_dot[f] = -range * w * w * std::sin(w * t + phase);
    };
    swing("hip_flexion_r", 0.15, 0.35, 0);
    swing("hip_flexion_l", 0.15, 0.35, 3.14);
    swing("knee_angle_r", 0.5, 0.4, 1);
    swing("knee_angle_l", 0.5, 0.4, 4.14);
    swing("ankle_angle_r", 0, 0.2, 2);
    swing("ankle_angle_l", 0, 0.2, 5.14);
  }
};

void soRow(benchmark::State& run) {
  Bench b;
  b.options.exponent = static_cast<double>(run.range(0));
  SoSolver solver(b.model, b.options);
  Eigen::VectorXd activations(solver.actuatorCount());
  double t = 0;
  double iterations = 0;
  for (auto _ : run) {
    b.setMotion(t);
    iterations += solver.solveInstant({0.0, b.q, b.u, b.u_dot}, b.loads, activations).iterations;
    t += 0.01;
  }
  run.counters["iterations"] = benchmark::Counter(iterations, benchmark::Counter::kAvgIterations);
}
BENCHMARK(soRow)->ArgName("exponent")->Arg(1)->Arg(2)->Arg(3)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace gaitmill

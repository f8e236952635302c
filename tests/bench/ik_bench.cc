// Inverse kinematics per frame: a walking-like motion of the project's model, its 66 markers with
// 5 mm of noise, each frame started from the one before.
#include <cmath>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/ik/ik_solver.h"
#include "tests/support/model_files.h"

namespace gaitmill {
namespace {

struct Bench {
  Model model{readOwnModel()};
  FreeCoordinates free{model};
  std::vector<std::string> names;
  IkOptions options;
  std::vector<Eigen::Matrix3Xd> frames;

  Bench() {
    for (const MarkerSpec& marker : model.spec().markers) {
      names.push_back(marker.name);
      options.tasks.markers.push_back({marker.name, 10.0});
    }
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 0.005);
    ModelState state(model);
    for (int frame = 0; frame < 100; ++frame) {
      state.setPose(makePose(0.01 * frame));
      Eigen::Matrix3Xd measured(3, static_cast<Eigen::Index>(names.size()));
      for (Eigen::Index i = 0; i < measured.cols(); ++i) {
        const MarkerSpec& marker = model.spec().markers[static_cast<std::size_t>(i)];
        measured.col(i) = state.pose(model.getBody(marker.body)) * marker.location;
      }
      frames.push_back(measured.unaryExpr([&](double x) { return x + noise(random); }));
    }
  }

  Eigen::VectorXd makePose(double t) const {
    Eigen::VectorXd q = model.defaultPose();
    for (const CoordinateIndex c : free.indices()) {
      const CoordinateSpec& spec = model.coordinate(c);
      const double middle = 0.5 * (spec.range_min + spec.range_max);
      // Once per second, as a stride does.
      q[c.value()] =
          middle + 0.15 * (spec.range_max - spec.range_min) * std::sin(6.28 * t + c.value());
    }
    free.conformPose(q);
    return q;
  }
};

void ikFrame(benchmark::State& run) {
  Bench b;
  IkSolver solver(b.model, b.options, b.names);
  Eigen::VectorXd q = b.makePose(0);
  std::size_t frame = 0;
  double iterations = 0;
  for (auto _ : run) {
    iterations += solver.solveFrame(b.frames[frame], q).iterations;
    frame = (frame + 1) % b.frames.size();
  }
  run.counters["iterations"] = benchmark::Counter(iterations, benchmark::Counter::kAvgIterations);
}
BENCHMARK(ikFrame)->Unit(benchmark::kMicrosecond);

void ikSearchOfTheFirstFrame(benchmark::State& run) {
  Bench b;
  IkSolver solver(b.model, b.options, b.names);
  Eigen::VectorXd q = b.makePose(0);
  for (auto _ : run) {
    benchmark::DoNotOptimize(solver.searchFrame(b.frames[0], q));
  }
}
BENCHMARK(ikSearchOfTheFirstFrame)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gaitmill

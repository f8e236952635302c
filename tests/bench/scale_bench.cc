// Scaling without a static trial: sizes, marker offsets and poses of the sample trial together.
#include <benchmark/benchmark.h>

#include "core/scale/motion_scale.h"
#include "tests/support/marker_set_files.h"
#include "tests/support/model_files.h"

namespace gaitmill {
namespace {

void scaleByMotion(benchmark::State& run) {
  ScaleOptions options;
  options.marker_set = readShippedMarkerSet("rajagopal2016");
  options.subject_mass = 70;
  MotionScaleOptions motion;
  motion.subject_height = 1.76;
  const MotionScaleSolver solver(readOwnModel(), options, motion);
  const MarkerTrajectories trial = readMarkerFile("models/sample/markers.trc");
  int iterations = 0;
  for (auto _ : run) {
    const ScaleResult result = solver.solve(trial);
    iterations = result.motion->iterations;
    benchmark::DoNotOptimize(result.factors.data());
  }
  run.counters["iterations"] = iterations;
}
BENCHMARK(scaleByMotion)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gaitmill

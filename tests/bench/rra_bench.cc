// One residual-reduction pass of the published walking trial (1.35 s of motion): bound 5 s, aim 1
// s.
#include <benchmark/benchmark.h>

#include "core/io/grf_reader.h"
#include "core/io/table_reader.h"
#include "core/rra/rra_solver.h"
#include "tests/support/model_files.h"
#include "tests/support/paper_rra.h"
#include "tests/support/shared_data.h"

namespace gaitmill {
namespace {

void residualReductionPassWalk(benchmark::State& run) {
  const std::string folder = findSharedFolder();
  if (folder.empty()) {
    run.SkipWithError("the shared trials are absent");
    return;
  }
  const ModelSpec model = readModelFile(folder + "/reference/walk/scale/subject_scaled.osim");
  const std::string motion_path = folder + "/reference/walk/ik/ik.mot";
  const std::string force_path = folder + "/data/walk/grf_walk.mot";
  const TimeSeries motion = toCoordinates(readTable(readFile(motion_path), motion_path), model);
  const GroundReaction reaction = readGroundReaction(readTable(readFile(force_path), force_path));
  RraOptions options = makePaperWalkRra();
  options.passes.resize(1);
  RraCounters counters;
  for (auto _ : run) {
    counters = solveRra(model, motion, reaction, options).passes[0].counters;
  }
  run.counters["windows"] = counters.windows;
  run.counters["steps"] = counters.steps;
  run.counters["rejected"] = counters.rejected_steps;
  run.counters["s_per_window"] = benchmark::Counter(
      counters.windows,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(residualReductionPassWalk)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gaitmill

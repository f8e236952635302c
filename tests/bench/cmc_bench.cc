// Computed muscle control on the published trials: 1.31 s of walking in less than 4 s, aimed at
// real time. Counters: windows, seconds simulated per second of processor, work per window.
#include <benchmark/benchmark.h>

#include "core/cmc/cmc_solver.h"
#include "tests/support/cmc_trial.h"
#include "tests/support/shared_data.h"

namespace gaitmill {
namespace {

void measure(benchmark::State& run, CmcTrial (*readTrial)(const std::string&)) {
  const std::string folder = findSharedFolder();
  if (folder.empty()) {
    run.SkipWithError("the shared trials are absent");
    return;
  }
  const CmcTrial trial = readTrial(folder);
  CmcResult result;
  for (auto _ : run) {
    result = solveCmc(trial.model, trial.reference, trial.loads, trial.options);
  }
  const double windows = result.counters.windows;
  const double simulated = result.activation.time.back() - result.activation.time.front();
  run.counters["windows"] = windows;
  run.counters["ms_per_window"] = benchmark::Counter(
      1e-3 * windows, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  run.counters["times_real_time"] =
      benchmark::Counter(simulated, benchmark::Counter::kIsIterationInvariantRate);
  run.counters["qp_steps"] = result.counters.qp_iterations / windows;
  run.counters["predictions"] = static_cast<double>(result.counters.predictions) / windows;
  run.counters["paths"] = static_cast<double>(result.counters.path_evaluations) / windows;
}

void muscleControlWalk(benchmark::State& run) {
  measure(run, readWalkTrial);
}
BENCHMARK(muscleControlWalk)->Unit(benchmark::kMillisecond);

void muscleControlRun(benchmark::State& run) {
  measure(run, readRunTrial);
}
BENCHMARK(muscleControlRun)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gaitmill

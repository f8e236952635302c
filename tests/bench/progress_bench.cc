// How long a pipeline can go without asking whether to go on: a job is cancelled within 100 ms.
// Counters: the longest silence over all stages [ms], and what its checkpoints weigh [KiB].
#include <algorithm>
#include <chrono>
#include <string>

#include <benchmark/benchmark.h>

#include "tests/support/sample_input.h"
#include "tests/support/shared_data.h"

namespace gaitmill {
namespace {

using Clock = std::chrono::steady_clock;

/// The longest time between two questions.
class Silence {
 public:
  void end() {
    const Clock::time_point now = Clock::now();
    longest_ = std::max(longest_, std::chrono::duration<double, std::milli>(now - last_).count());
    last_ = now;
  }
  double longest() const { return longest_; }

 private:
  Clock::time_point last_ = Clock::now();
  double longest_ = 0;
};

void measure(benchmark::State& run, const TrialInput& input, const std::string& settings) {
  double longest = 0;
  double checkpoints = 0;
  for (auto _ : run) {
    Silence silence;
    PipelineEvents events;
    checkpoints = 0;
    events.progress = [&](Stage, double) {
      silence.end();
      return true;
    };
    events.stage_done = [&](const StageOutcome& outcome) {
      checkpoints += static_cast<double>(outcome.checkpoint.size()) / 1024;
    };
    Pipeline().run(input, readInput(settings), events);
    silence.end();
    longest = std::max(longest, silence.longest());
  }
  run.counters["silence_ms"] = longest;
  run.counters["checkpoints_kib"] = checkpoints;
}

void pipelineSample(benchmark::State& run) {
  measure(run, readSampleInput(), "models/settings/default.json");
}
BENCHMARK(pipelineSample)->Unit(benchmark::kMillisecond);

void pipelineWalk(benchmark::State& run) {
  const std::string folder = findSharedFolder() + "/data/walk/";
  if (folder == "/data/walk/") {
    run.SkipWithError("the shared trials are absent");
    return;
  }
  TrialInput input;
  input.static_markers = readInput(folder + "static_walk_1.trc");
  input.static_markers_2 = readInput(folder + "static_walk_2.trc");
  input.markers = readInput(folder + "motion_capture_walk.trc");
  input.ground_reaction = readInput(folder + "grf_walk.mot");
  input.mass = 85.0668;
  input.height = 1.829;
  measure(run, input, "models/settings/paper_walk.json");
}
BENCHMARK(pipelineWalk)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gaitmill

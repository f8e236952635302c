// Inverse dynamics of the published walking trial: bound 50 us per frame.
#include <benchmark/benchmark.h>

#include "core/id/id_solver.h"
#include "core/io/grf_reader.h"
#include "core/io/table_reader.h"
#include "tests/support/model_files.h"
#include "tests/support/shared_data.h"

namespace gaitmill {
namespace {

void inverseDynamicsWalk(benchmark::State& run) {
  const std::string folder = findSharedFolder();
  if (folder.empty()) {
    run.SkipWithError("the shared trials are absent");
    return;
  }
  const Model model(readModelFile(folder + "/reference/walk/subject_adjusted.osim"));
  const std::string motion_path = folder + "/reference/walk/rra/pass2/kinematics_q.sto";
  const std::string force_path = folder + "/data/walk/grf_walk.mot";
  const TimeSeries motion =
      toCoordinates(readTable(readFile(motion_path), motion_path), model.spec());
  const ExternalLoads loads(model, readGroundReaction(readTable(readFile(force_path), force_path)));
  IdSolver solver(model, {});
  int frames = 0;
  for (auto _ : run) {
    frames = solver.solve(motion, &loads).generalized_forces.rowCount();
  }
  run.counters["frames"] = frames;
  run.counters["s_per_frame"] = benchmark::Counter(
      frames, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(inverseDynamicsWalk)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gaitmill

// Reading and writing of whole files, in memory.

#include <string>

#include <benchmark/benchmark.h>

#include "core/io/c3d_reader.h"
#include "core/io/files.h"
#include "core/io/osim_reader.h"
#include "core/io/osim_writer.h"
#include "core/io/table_reader.h"
#include "core/io/table_writer.h"
#include "core/io/trc_reader.h"
#include "tests/support/shared_data.h"

namespace gaitmill {
namespace {

template <class Work>
void measure(benchmark::State& state, const std::string& path, Work work) {
  const std::string bytes = readFile(path);
  for (auto _ : state) {
    benchmark::DoNotOptimize(work(bytes));
  }
  state.SetBytesProcessed(state.iterations() * static_cast<long>(bytes.size()));
}

void BM_ReadModel(benchmark::State& state) {
  measure(state, "models/rajagopal2016/rajagopal2016.osim", [](const std::string& bytes) {
    return readOsim(bytes, "m.osim");
  });
}
BENCHMARK(BM_ReadModel)->Unit(benchmark::kMillisecond);

void BM_WriteModel(benchmark::State& state) {
  const std::string path = "models/rajagopal2016/rajagopal2016.osim";
  const ModelSpec spec = readOsim(readFile(path), path);
  for (auto _ : state) {
    benchmark::DoNotOptimize(writeOsim(spec));
  }
}
BENCHMARK(BM_WriteModel)->Unit(benchmark::kMillisecond);

void BM_ReadGroundReactionTable(benchmark::State& state) {
  measure(state, findSharedFolder() + "/data/walk/grf_walk.mot", [](const std::string& bytes) {
    return readTable(bytes, "g.mot");
  });
}
BENCHMARK(BM_ReadGroundReactionTable)->Unit(benchmark::kMillisecond);

void BM_WriteGroundReactionTable(benchmark::State& state) {
  const std::string path = findSharedFolder() + "/data/walk/grf_walk.mot";
  const TimeSeries table = readTable(readFile(path), path).table;
  for (auto _ : state) {
    benchmark::DoNotOptimize(writeTable(table));
  }
}
BENCHMARK(BM_WriteGroundReactionTable)->Unit(benchmark::kMillisecond);

void BM_ReadMarkers(benchmark::State& state) {
  measure(state,
          findSharedFolder() + "/data/run/paper_subject01/motion_capture_run.trc",
          [](const std::string& bytes) { return readTrc(bytes, "m.trc"); });
}
BENCHMARK(BM_ReadMarkers)->Unit(benchmark::kMillisecond);

void BM_ReadC3d(benchmark::State& state) {
  measure(state,
          findSharedFolder() + "/data/c3d/walking2.c3d",
          [](const std::string& bytes) { return readC3d(bytes, "m.c3d"); });
}
BENCHMARK(BM_ReadC3d)->Unit(benchmark::kMillisecond);

// DEC integers: every number takes the longest way.
void BM_ReadDecC3d(benchmark::State& state) {
  measure(state,
          findSharedFolder() + "/data/c3d/c3d_org_sample01/Eb015vi.c3d",
          [](const std::string& bytes) { return readC3d(bytes, "m.c3d"); });
}
BENCHMARK(BM_ReadDecC3d)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gaitmill

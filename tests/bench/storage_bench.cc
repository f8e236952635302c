// The database on a real disk: durable submissions from several threads, polls, claims, a start
// with 10 000 stored jobs, a large upload beside small writes.

#include <atomic>
#include <chrono>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <benchmark/benchmark.h>

#include "service/storage/database.h"
#include "service/storage/job_store.h"
#include "service/storage/trial_store.h"
#include "tests/support/temporary_folder.h"

namespace gaitmill {
namespace {

constexpr const char* kTenant = "bench";
constexpr int kStoredJobs = 10'000;

NewTrial makeTrial(std::string markers) {
  NewTrial trial;
  trial.tenant = kTenant;
  trial.subject.mass = 70;
  trial.subject.height = 1.7;
  if (!markers.empty()) {
    trial.files["markers"] = {"walk.trc", api::makeByteSource(std::move(markers))};
  }
  return trial;
}

NewJob makeJob(const std::string& trial_id) {
  NewJob job;
  job.tenant = kTenant;
  job.trial_id = trial_id;
  job.settings_name = "default";
  job.settings_json = std::string(6'000, ' ') + "{}";  // as long as the document of defaults
  return job;
}

std::string makeNoise(std::size_t size) {
  std::mt19937 random(1);
  std::string noise(size, '\0');
  for (char& byte : noise) {
    byte = static_cast<char>(random() & 0xffU);
  }
  return noise;
}

// One database for all threads of a benchmark.
struct Shared {
  Shared() : database({folder / "mill.db"}), trials(database), jobs(database) {
    trial = trials.add(makeTrial(std::string(50'000, 'x'))).id;
  }
  TemporaryFolder folder;
  Database database;
  TrialStore trials;
  JobStore jobs;
  std::string trial;
};

std::unique_ptr<Shared> shared;

void setUp(const benchmark::State&) {
  shared = std::make_unique<Shared>();
}
void tearDown(const benchmark::State&) {
  shared.reset();
}

void BM_SubmitJobDurably(benchmark::State& state) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(shared->jobs.submit(makeJob(shared->trial)));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BM_SubmitJobDurably)
    ->Setup(setUp)
    ->Teardown(tearDown)
    ->ThreadRange(1, 64)
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);

// A trial of 50 kB, its own bytes each time, and a job on it.
void BM_SubmitTrialAndJobDurably(benchmark::State& state) {
  static std::atomic<int> serial{0};
  for (auto _ : state) {
    std::string markers = std::to_string(++serial);
    markers.resize(50'000, 'x');
    const std::string trial = shared->trials.add(makeTrial(std::move(markers))).id;
    benchmark::DoNotOptimize(shared->jobs.submit(makeJob(trial)));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BM_SubmitTrialAndJobDurably)
    ->Setup(setUp)
    ->Teardown(tearDown)
    ->ThreadRange(1, 64)
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);

void BM_PollRunningJob(benchmark::State& state) {
  const std::string id = shared->jobs.submit(makeJob(shared->trial));
  const JobTicket ticket = shared->jobs.claimNext("serve:1", std::chrono::hours(1)).value().ticket;
  shared->jobs.saveProgress(ticket, {{"scale", 1, 1}, {"ik", 2, 1}, {"rra", 3, 0.5}}, {"careful"});
  for (auto _ : state) {
    benchmark::DoNotOptimize(shared->jobs.find(kTenant, id));
  }
}
BENCHMARK(BM_PollRunningJob)->Setup(setUp)->Teardown(tearDown)->Unit(benchmark::kMicrosecond);

void storeManyJobs(Shared& s) {
  std::vector<std::thread> threads;
  for (int t = 0; t < 32; ++t) {
    threads.emplace_back([&s, t] {
      for (int i = t; i < kStoredJobs; i += 32) {
        s.jobs.submit(makeJob(s.trial));
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
}

// The last of 10 000 queued jobs: its place in the queue is counted.
void BM_PollLastOfManyQueuedJobs(benchmark::State& state) {
  storeManyJobs(*shared);
  const std::string id = shared->jobs.submit(makeJob(shared->trial));
  for (auto _ : state) {
    benchmark::DoNotOptimize(shared->jobs.find(kTenant, id));
  }
}
BENCHMARK(BM_PollLastOfManyQueuedJobs)
    ->Setup(setUp)
    ->Teardown(tearDown)
    ->Unit(benchmark::kMicrosecond);

// Opens the file, takes over from the last service, lists and claims.
void BM_StartWithManyStoredJobs(benchmark::State& state) {
  const TemporaryFolder& folder = shared->folder;
  storeManyJobs(*shared);
  for (auto _ : state) {
    Database database({folder / "mill.db", DatabaseUse::kWork});
    JobStore jobs(database);
    TrialStore trials(database);
    benchmark::DoNotOptimize(trials.removeUnfinishedUploads());
    benchmark::DoNotOptimize(jobs.lapseLeases("serve:"));
    benchmark::DoNotOptimize(jobs.list(kTenant, {}, {}));
    benchmark::DoNotOptimize(jobs.claimNext("serve:2", std::chrono::hours(1)));
  }
}
BENCHMARK(BM_StartWithManyStoredJobs)
    ->Setup(setUp)
    ->Teardown(tearDown)
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

void BM_UploadLargeFile(benchmark::State& state) {
  const std::string noise = makeNoise(50'000'000);
  for (auto _ : state) {
    const std::string id = shared->trials.add(makeTrial(noise)).id;
    state.PauseTiming();
    shared->trials.remove(kTenant, id);
    state.ResumeTiming();
  }
  state.SetBytesProcessed(state.iterations() * static_cast<long>(noise.size()));
}
BENCHMARK(BM_UploadLargeFile)
    ->Setup(setUp)
    ->Teardown(tearDown)
    ->Iterations(2)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

// How long a small write waits while a large upload goes in.
void BM_SubmitJobBesideAnUpload(benchmark::State& state) {
  const std::string noise = makeNoise(100'000'000);
  std::atomic<bool> stopping{false};
  std::thread upload([&] {
    while (!stopping) {
      const std::string id = shared->trials.add(makeTrial(noise)).id;
      shared->trials.remove(kTenant, id);
    }
  });
  for (auto _ : state) {
    benchmark::DoNotOptimize(shared->jobs.submit(makeJob(shared->trial)));
  }
  stopping = true;
  upload.join();
}
BENCHMARK(BM_SubmitJobBesideAnUpload)
    ->Setup(setUp)
    ->Teardown(tearDown)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gaitmill

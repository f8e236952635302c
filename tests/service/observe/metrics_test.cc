#include "service/observe/metrics.h"

#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/service/observe/exposition.h"

namespace gaitmill {
namespace {

TEST(Metrics, AreRenderedInTheTextFormat) {
  Metrics metrics;
  metrics.declareCounter("jobs_total", "Jobs.");
  metrics.declareGauge("depth", "Jobs that wait.\nSecond \\ line.");
  metrics.declareHistogram("seconds", "Time.", {0.5, 2});
  metrics.add("jobs_total", {{"state", "with \"quotes\" \\ and\nline"}}, 2);
  metrics.set("depth", {}, 3.5);
  for (const double value : {0.1, 0.5, 1.0, 7.0}) {
    metrics.observe("seconds", {{"stage", "ik"}}, value);
  }
  EXPECT_EQ(metrics.render(),
            "# HELP depth Jobs that wait.\\nSecond \\\\ line.\n# TYPE depth gauge\ndepth 3.5\n"
            "# HELP jobs_total Jobs.\n# TYPE jobs_total counter\n"
            "jobs_total{state=\"with \\\"quotes\\\" \\\\ and\\nline\"} 2\n"
            "# HELP seconds Time.\n# TYPE seconds histogram\n"
            "seconds_bucket{stage=\"ik\",le=\"0.5\"} 2\n"
            "seconds_bucket{stage=\"ik\",le=\"2\"} 3\n"
            "seconds_bucket{stage=\"ik\",le=\"+Inf\"} 4\n"
            "seconds_sum{stage=\"ik\"} 8.6\nseconds_count{stage=\"ik\"} 4\n");
  EXPECT_EQ(parseExposition(metrics.render()).faults, std::vector<std::string>());
}

TEST(Metrics, TheStrictReaderFindsFaults) {
  for (const char* text : {"depth 1\n",
                           "# HELP a b\n# TYPE a gauge\na 1",
                           "# HELP a b\n# TYPE a gauge\na one\n",
                           "# HELP a b\n# TYPE a gauge\na 1\na 1\n",
                           "# HELP a b\n# TYPE a gauge\nb 1\n",
                           "# HELP a b\n# TYPE a histogram\na_bucket{le=\"1\"} 2\n"
                           "a_bucket{le=\"+Inf\"} 1\na_sum 1\na_count 1\n"}) {
    EXPECT_FALSE(parseExposition(text).faults.empty()) << text;
  }
}

TEST(Metrics, MistakesInNamesAreFaultsOfOurOwn) {
  Metrics metrics;
  metrics.declareCounter("a", "");
  EXPECT_THROW(metrics.declareGauge("a", ""), Error);
  EXPECT_THROW(metrics.declareGauge("a b", ""), Error);
  EXPECT_THROW(metrics.set("a", {}, 1), Error);
  EXPECT_THROW(metrics.add("b"), Error);
}

TEST(Metrics, CountFromManyThreads) {
  Metrics metrics;
  metrics.declareCounter("a", "");
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      for (int j = 0; j < 1000; ++j) {
        metrics.add("a");
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  EXPECT_EQ(parseExposition(metrics.render()).samples["a"], 4000);
}

TEST(Metrics, TheProcessTellsWhatItUses) {
  Metrics metrics;
  addProcessMetrics(metrics);
  const Exposition exposition = parseExposition(metrics.render());
  EXPECT_TRUE(exposition.faults.empty());
  EXPECT_GT(exposition.samples.at("process_resident_memory_bytes"), 1e5);
  EXPECT_GT(exposition.samples.at("process_open_fds"), 2);
  EXPECT_GT(exposition.samples.at("process_start_time_seconds"), 1.7e9);
}

}  // namespace
}  // namespace gaitmill

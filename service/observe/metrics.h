#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace gaitmill {

/// Names and values that tell the series of one metric apart: {{"route", "/v1/jobs"}}. Few values
/// each: every combination is a series that is kept for good.
using MetricLabels = std::vector<std::pair<std::string, std::string>>;

/// Counters, gauges and histograms in Prometheus text format 0.0.4. A metric exists from its
/// declaration, so that a dashboard finds it before its first event. Safe from any thread.
class Metrics {
 public:
  /// @throws Error kInternal if the name is taken or no metric's name; so do the others
  void declareCounter(const std::string& name, const std::string& help);
  void declareGauge(const std::string& name, const std::string& help);
  /// @param bounds  upper ends of the buckets, ascending; the one without end is added
  void declareHistogram(const std::string& name,
                        const std::string& help,
                        std::vector<double> bounds);

  /// Adds to a counter.
  void add(const std::string& name, const MetricLabels& labels = {}, double amount = 1);
  /// Sets a gauge.
  void set(const std::string& name, const MetricLabels& labels, double value);
  /// Puts one observation into a histogram.
  void observe(const std::string& name, const MetricLabels& labels, double value);

  /// Called at the beginning of each render(), to set what is not counted but looked up.
  void addCollector(std::function<void(Metrics&)> collector);

  std::string render();

 private:
  enum class Kind { kCounter, kGauge, kHistogram };
  struct Series {
    double value = 0;  ///< of a histogram: the sum
    std::uint64_t count = 0;
    std::vector<std::uint64_t> buckets;
  };
  struct Family {
    Kind kind = Kind::kCounter;
    std::string help;
    std::vector<double> bounds;
    std::map<std::string, Series> series;  ///< by rendered labels
  };

  void declare(const std::string& name, Family family);
  Series& seriesOf(const std::string& name, Kind kind, const MetricLabels& labels);
  static void renderFamily(const std::string& name, const Family& family, std::string& text);
  static void renderHistogram(const std::string& name,
                              const std::string& labels,
                              const Family& family,
                              const Series& series,
                              std::string& text);

  std::mutex guard_;
  std::map<std::string, Family> families_;
  std::vector<std::function<void(Metrics&)>> collectors_;
};

/// Declares and collects what the process itself uses: resident memory, processor seconds, open
/// files, threads, start time; the usual process_… names.
void addProcessMetrics(Metrics& metrics);

}  // namespace gaitmill

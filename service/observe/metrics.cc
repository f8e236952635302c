#include "service/observe/metrics.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "core/base/error.h"

namespace gaitmill {

namespace {

std::string escape(const std::string& text, bool is_label) {
  std::string out;
  for (const char letter : text) {
    if (letter == '\\') {
      out += "\\\\";
    } else if (letter == '\n') {
      out += "\\n";
    } else if (letter == '"' && is_label) {
      out += "\\\"";
    } else {
      out += letter;
    }
  }
  return out;
}

std::string renderLabels(const MetricLabels& labels) {
  std::string text;
  for (const auto& [name, value] : labels) {
    text += (text.empty() ? "" : ",") + name + "=\"" + escape(value, true) + "\"";
  }
  return text;
}

std::string renderNumber(double value) {
  if (std::isnan(value)) {
    return "NaN";
  }
  if (std::isinf(value)) {
    return value > 0 ? "+Inf" : "-Inf";
  }
  return fmt::format("{}", value);
}

void renderSample(const std::string& name,
                  const std::string& labels,
                  const std::string& value,
                  std::string& text) {
  text += name + (labels.empty() ? "" : "{" + labels + "}") + " " + value + "\n";
}

}  // namespace

void Metrics::declareCounter(const std::string& name, const std::string& help) {
  declare(name, {Kind::kCounter, help, {}, {}});
}

void Metrics::declareGauge(const std::string& name, const std::string& help) {
  declare(name, {Kind::kGauge, help, {}, {}});
}

void Metrics::declareHistogram(const std::string& name,
                               const std::string& help,
                               std::vector<double> bounds) {
  check(std::is_sorted(bounds.begin(), bounds.end()), "buckets ascend");
  declare(name, {Kind::kHistogram, help, std::move(bounds), {}});
}

void Metrics::declare(const std::string& name, Family family) {
  static const std::regex word("[a-zA-Z_:][a-zA-Z0-9_:]*");
  check(std::regex_match(name, word), "a metric's name has letters, digits and _");
  const std::lock_guard<std::mutex> lock(guard_);
  check(families_.emplace(name, std::move(family)).second, "a metric is declared once");
}

Metrics::Series& Metrics::seriesOf(const std::string& name, Kind kind, const MetricLabels& labels) {
  const auto family = families_.find(name);
  check(family != families_.end() && family->second.kind == kind, "a metric is declared first");
  Series& series = family->second.series[renderLabels(labels)];
  series.buckets.resize(family->second.bounds.size());
  return series;
}

void Metrics::add(const std::string& name, const MetricLabels& labels, double amount) {
  const std::lock_guard<std::mutex> lock(guard_);
  seriesOf(name, Kind::kCounter, labels).value += amount;
}

void Metrics::set(const std::string& name, const MetricLabels& labels, double value) {
  const std::lock_guard<std::mutex> lock(guard_);
  seriesOf(name, Kind::kGauge, labels).value = value;
}

void Metrics::observe(const std::string& name, const MetricLabels& labels, double value) {
  const std::lock_guard<std::mutex> lock(guard_);
  Series& series = seriesOf(name, Kind::kHistogram, labels);
  const std::vector<double>& bounds = families_.at(name).bounds;
  series.value += value;
  ++series.count;
  const auto bucket = std::lower_bound(bounds.begin(), bounds.end(), value);
  if (bucket != bounds.end()) {
    ++series.buckets[static_cast<std::size_t>(bucket - bounds.begin())];
  }
}

void Metrics::addCollector(std::function<void(Metrics&)> collector) {
  const std::lock_guard<std::mutex> lock(guard_);
  collectors_.push_back(std::move(collector));
}

std::string Metrics::render() {
  std::vector<std::function<void(Metrics&)>> collectors;
  {
    const std::lock_guard<std::mutex> lock(guard_);
    collectors = collectors_;
  }
  for (const auto& collect : collectors) {
    collect(*this);
  }
  const std::lock_guard<std::mutex> lock(guard_);
  std::string text;
  for (const auto& [name, family] : families_) {
    renderFamily(name, family, text);
  }
  return text;
}

void Metrics::renderFamily(const std::string& name, const Family& family, std::string& text) {
  static constexpr const char* kKinds[] = {"counter", "gauge", "histogram"};
  text += "# HELP " + name + " " + escape(family.help, false) + "\n";
  text += "# TYPE " + name + " " + kKinds[static_cast<int>(family.kind)] + "\n";
  for (const auto& [labels, series] : family.series) {
    if (family.kind == Kind::kHistogram) {
      renderHistogram(name, labels, family, series, text);
    } else {
      renderSample(name, labels, renderNumber(series.value), text);
    }
  }
}

// Buckets count everything up to their end, so each holds those before it.
void Metrics::renderHistogram(const std::string& name,
                              const std::string& labels,
                              const Family& family,
                              const Series& series,
                              std::string& text) {
  const std::string comma = labels.empty() ? "" : ",";
  std::uint64_t below = 0;
  for (std::size_t i = 0; i < family.bounds.size(); ++i) {
    below += series.buckets[i];
    const std::string end = "le=\"" + renderNumber(family.bounds[i]) + "\"";
    renderSample(name + "_bucket", labels + comma + end, std::to_string(below), text);
  }
  const std::string count = std::to_string(series.count);
  renderSample(name + "_bucket", labels + comma + "le=\"+Inf\"", count, text);
  renderSample(name + "_sum", labels, renderNumber(series.value), text);
  renderSample(name + "_count", labels, count, text);
}

}  // namespace gaitmill

#pragma once

#include <map>
#include <string>
#include <vector>

namespace gaitmill {

/// The samples of a text in Prometheus format 0.0.4, by name with labels as written.
struct Exposition {
  std::map<std::string, double> samples;  ///< "jobs{state=\"queued\"}" -> 3
  std::map<std::string, std::string> types;
  std::vector<std::string> faults;  ///< with their line; empty if the text is right
};

/// Reads strictly: grammar of every line, HELP and TYPE before the samples of a metric and once,
/// all samples of a metric together, no sample twice, buckets that ascend and end in the count.
Exposition parseExposition(const std::string& text);

}  // namespace gaitmill

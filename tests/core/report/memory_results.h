#pragma once

#include <map>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/figure/result_source.h"

namespace gaitmill {

/// Results that a test has written down.
class MemoryResults : public ResultSource {
 public:
  explicit MemoryResults(std::string summary) : summary_(std::move(summary)) {}

  std::map<std::string, TimeSeries> tables;
  std::map<std::string, TimeSeries> cycle_tables;

  bool has(const std::string& table, Axis axis) const override { return of(axis).count(table) > 0; }
  const TimeSeries& table(const std::string& table, Axis axis) const override {
    const auto found = of(axis).find(table);
    require(found != of(axis).end(), ErrorCode::kResultNotFound, "no table " + table);
    return found->second;
  }
  const std::string& summary() const override { return summary_; }

 private:
  const std::map<std::string, TimeSeries>& of(Axis axis) const {
    return axis == Axis::kTime ? tables : cycle_tables;
  }

  std::string summary_;
};

}  // namespace gaitmill

#pragma once

#include <map>
#include <string>
#include <utility>

#include "core/base/error.h"
#include "core/figure/result_source.h"

namespace gaitmill {

/// Results of a job that are at hand as values.
class MemoryResults final : public ResultSource {
 public:
  MemoryResults(std::map<std::string, TimeSeries> tables,
                std::map<std::string, TimeSeries> cycle_tables,
                std::string summary)
      : tables_(std::move(tables)),
        cycle_tables_(std::move(cycle_tables)),
        summary_(std::move(summary)) {}

  bool has(const std::string& table, Axis axis) const override {
    return select(axis).count(table) == 1;
  }
  const TimeSeries& table(const std::string& table, Axis axis) const override {
    require(has(table, axis), ErrorCode::kResultNotFound, "there is no table '" + table + "'");
    return select(axis).at(table);
  }
  const std::string& summary() const override { return summary_; }

 private:
  const std::map<std::string, TimeSeries>& select(Axis axis) const {
    return axis == Axis::kTime ? tables_ : cycle_tables_;
  }

  std::map<std::string, TimeSeries> tables_;
  std::map<std::string, TimeSeries> cycle_tables_;
  std::string summary_;
};

}  // namespace gaitmill

#pragma once

#include <string>

#include "core/figure/result_source.h"
#include "core/pipeline/pipeline.h"

namespace gaitmill {

/// The results of a run that has just ended.
class RunResults : public ResultSource {
 public:
  /// @param result  outlives this
  explicit RunResults(const PipelineResult& result) : result_(result) {}

  bool has(const std::string& table, Axis axis) const override;
  const TimeSeries& table(const std::string& table, Axis axis) const override;
  const std::string& summary() const override { return result_.summary_json; }

 private:
  const std::map<std::string, TimeSeries>& tablesOf(Axis axis) const;

  const PipelineResult& result_;
};

}  // namespace gaitmill

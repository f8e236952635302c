#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>

#include "core/figure/result_source.h"
#include "service/storage/job_store.h"

namespace gaitmill {

/// The results of a stored job: a table is read and decoded when it is first asked for. For one
/// thread.
class StoredResults : public ResultSource {
 public:
  /// @param jobs  outlives this
  /// @throws Error kJobNotFound
  StoredResults(JobStore& jobs, std::string tenant, std::string job_id);

  bool has(const std::string& table, Axis axis) const override;
  const TimeSeries& table(const std::string& table, Axis axis) const override;
  /// Of a job without a summary yet an empty object.
  const std::string& summary() const override;

 private:
  using Key = std::pair<ResultKind, std::string>;

  JobStore& jobs_;
  std::string tenant_;
  std::string job_id_;
  std::set<Key> known_;
  mutable std::map<Key, TimeSeries> tables_;
  mutable std::string summary_;
};

}  // namespace gaitmill

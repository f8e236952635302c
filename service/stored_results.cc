#include "service/stored_results.h"

#include <utility>

#include "service/storage/table_codec.h"

namespace gaitmill {

namespace {

constexpr const char* kSummary = "summary";

ResultKind kindOf(ResultSource::Axis axis) {
  return axis == ResultSource::Axis::kCycle ? ResultKind::kCycle : ResultKind::kTime;
}

}  // namespace

StoredResults::StoredResults(JobStore& jobs, std::string tenant, std::string job_id)
    : jobs_(jobs), tenant_(std::move(tenant)), job_id_(std::move(job_id)) {
  for (const ResultInfo& result : jobs_.listResults(tenant_, job_id_)) {
    known_.emplace(result.kind, result.name);
  }
}

bool StoredResults::has(const std::string& table, Axis axis) const {
  return known_.count({kindOf(axis), table}) > 0;
}

const TimeSeries& StoredResults::table(const std::string& table, Axis axis) const {
  const Key key(kindOf(axis), table);
  const auto found = tables_.find(key);
  if (found != tables_.end()) {
    return found->second;
  }
  const StoredResult stored = jobs_.readResult(tenant_, job_id_, key.first, table);
  return tables_.emplace(key, decodeTable(stored.bytes)).first->second;
}

const std::string& StoredResults::summary() const {
  if (summary_.empty()) {
    summary_ = known_.count({ResultKind::kSummary, kSummary}) == 0
                   ? "{}"
                   : jobs_.readResult(tenant_, job_id_, ResultKind::kSummary, kSummary).bytes;
  }
  return summary_;
}

}  // namespace gaitmill

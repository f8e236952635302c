#include "service/result_service.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "service/storage/table_codec.h"

namespace gaitmill {

ResultService::ResultService(JobStore& store, StoEncoder encode_sto)
    : store_(store), encode_sto_(std::move(encode_sto)) {}

TimeSeries ResultService::findTable(const std::string& job_id,
                                    const std::string& name,
                                    api::TableAxis axis) {
  const ResultKind kind = axis == api::TableAxis::kCycle ? ResultKind::kCycle : ResultKind::kTime;
  return decodeTable(store_.readResult(job_id, kind, name));
}

std::string ResultService::findQuality(const std::string& job_id) {
  return store_.readResult(job_id, ResultKind::kSummary, "quality");
}

std::string ResultService::encodeSto(const TimeSeries& table, api::AngleUnit angles) {
  return encode_sto_(table, angles);
}

std::vector<api::FileView> ResultService::listFiles(const std::string& job_id) {
  return store_.listFiles(job_id);
}

api::FileContent ResultService::findFile(const std::string& job_id, const std::string& name) {
  return store_.readFile(job_id, name);
}

std::vector<ResultItem> makeResultItems(const PipelineResult& result) {
  std::vector<ResultItem> items;
  for (const auto& [name, bytes] : result.files) {
    items.push_back({ResultKind::kFile, name, bytes});
  }
  for (const auto& [name, table] : result.tables) {
    items.push_back({ResultKind::kTime, name, encodeTable(table)});
  }
  for (const auto& [name, table] : result.cycle_tables) {
    items.push_back({ResultKind::kCycle, name, encodeTable(table)});
  }
  const auto summary = nlohmann::json::parse(result.summary_json);
  const auto quality = summary.value("quality", nlohmann::json::object());
  items.push_back({ResultKind::kSummary, "summary", result.summary_json});
  items.push_back({ResultKind::kSummary, "quality", quality.dump()});
  return items;
}

}  // namespace gaitmill

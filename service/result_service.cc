#include "service/result_service.h"

#include <algorithm>
#include <utility>

#include "service/storage/table_codec.h"

namespace gaitmill {

namespace {

constexpr const char* kQuality = "quality";

// In the order of api::tableNames(), the quality last.
std::size_t findRank(const std::string& name) {
  const std::vector<std::string>& names = api::tableNames();
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

api::ResultView& findOrAdd(std::vector<api::ResultView>& views, const std::string& name) {
  const auto found = std::find_if(
      views.begin(), views.end(), [&name](const auto& view) { return view.name == name; });
  return found != views.end() ? *found : views.emplace_back(api::ResultView{name, "", false});
}

}  // namespace

ResultService::ResultService(Stores& stores, JobArchive& archive, StoEncoder encode_sto)
    : stores_(stores), archive_(archive), encode_sto_(std::move(encode_sto)) {}

std::vector<api::ResultView> ResultService::list(const api::Identity& who,
                                                 const std::string& job_id) {
  std::vector<api::ResultView> views;
  for (const ResultInfo& result : stores_.jobs.listResults(who.tenant, job_id)) {
    const bool is_table = result.kind == ResultKind::kTime || result.kind == ResultKind::kCycle;
    if (!is_table && !(result.kind == ResultKind::kSummary && result.name == kQuality)) {
      continue;
    }
    api::ResultView& view = findOrAdd(views, result.name);
    view.has_cycle = view.has_cycle || result.kind == ResultKind::kCycle;
    if (result.kind != ResultKind::kCycle) {
      view.stage = result.stage;
    }
  }
  std::stable_sort(views.begin(), views.end(), [](const auto& a, const auto& b) {
    return findRank(a.name) < findRank(b.name);
  });
  return views;
}

api::ResultTable ResultService::findTable(const api::Identity& who,
                                          const std::string& job_id,
                                          const std::string& name,
                                          api::TableAxis axis) {
  const ResultKind kind = axis == api::TableAxis::kCycle ? ResultKind::kCycle : ResultKind::kTime;
  // The job first: a table read after it is at least as new, so "final" is never said too early.
  api::JobView job = stores_.jobs.find(who.tenant, job_id);
  const StoredResult stored = stores_.jobs.readResult(who.tenant, job_id, kind, name);
  api::ResultTable result;
  result.table = decodeTable(stored.bytes);
  result.stage = stored.info.stage;
  result.provenance = std::move(job.provenance);
  result.settings_json = std::move(job.settings_json);
  result.is_final = api::isFinal(job.state);
  return result;
}

std::string ResultService::findQuality(const api::Identity& who, const std::string& job_id) {
  return stores_.jobs.readResult(who.tenant, job_id, ResultKind::kSummary, kQuality).bytes;
}

std::string ResultService::encodeSto(const TimeSeries& table, api::AngleUnit angles) {
  return encode_sto_(table, angles);
}

std::vector<api::FileView> ResultService::listFiles(const api::Identity& who,
                                                    const std::string& job_id) {
  return stores_.jobs.listFiles(who.tenant, job_id);
}

api::FileContent ResultService::findFile(const api::Identity& who,
                                         const std::string& job_id,
                                         const std::string& name) {
  return stores_.jobs.readFile(who.tenant, job_id, name);
}

api::FileContent ResultService::makeArchive(const api::Identity& who, const std::string& job_id) {
  return archive_.make(who, job_id);
}

}  // namespace gaitmill

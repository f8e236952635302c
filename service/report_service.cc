#include "service/report_service.h"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "api/dto/object_reader.h"
#include "api/dto/timestamp.h"
#include "core/base/error.h"
#include "service/job_tag.h"
#include "service/provenance.h"
#include "service/run_views.h"
#include "service/shipped_catalog.h"

namespace gaitmill {

namespace {

using nlohmann::json;

constexpr std::uint64_t kMaxImage = 64U << 20U;  // [bytes]

}  // namespace

ReportService::ReportService(Stores& stores,
                             FigureFunctions functions,
                             api::ImagePort& images,
                             ByteCache& cache)
    : stores_(stores), functions_(std::move(functions)), images_(images), cache_(cache) {}

// Also over what the report says of the job itself, which provenance knows nothing of.
std::string ReportService::findTag(const api::Identity& who, const std::string& job_id) {
  const api::JobView job = stores_.jobs.find(who.tenant, job_id);
  return makeTag({"report", identifyResults(job), job.id, images_.findTag(who, job_id, {})});
}

api::JobView ReportService::requireSucceeded(const api::Identity& who, const std::string& job_id) {
  api::JobView job = stores_.jobs.find(who.tenant, job_id);
  require(job.state == api::JobState::kSucceeded,
          ErrorCode::kResultNotReady,
          "the verdict is there when the job has succeeded; it is " +
              std::string(api::jobStateName(job.state)),
          {"", 0, 0, "state"});
  return job;
}

std::string ReportService::findQuality(const api::Identity& who, const std::string& job_id) {
  const api::JobView job = requireSucceeded(who, job_id);
  const StoredResults results(stores_.jobs, who.tenant, job_id);
  const json summary = json::parse(results.summary(), nullptr, false);
  check(summary.is_object(), "a summary is not a JSON object");
  json quality = {{"job", job.id},
                  {"verdict", job.verdict},
                  {"provenance", job.provenance},
                  {"warnings", job.warnings},
                  {"report", "/v1/jobs/" + job.id + "/report.html"}};
  const json figures = summary.value("quality", json::object());
  quality["reasons"] = figures.value("reasons", json::array());
  quality["checks"] = figures.value("checks", json::array());
  quality["stages"] = figures.value("stages", json::object());
  quality["figures"] = figures;
  for (const char* name : {"verdict", "reasons", "checks", "stages"}) {
    quality["figures"].erase(name);
  }
  return api::dumpJson(quality);
}

std::string ReportService::render(const api::Identity& who, const std::string& job_id) {
  const api::JobView job = requireSucceeded(who, job_id);
  const std::string tag = findTag(who, job_id);
  if (const ByteCache::Value kept = cache_.find(tag)) {
    return kept->bytes;
  }
  const StoredResults results(stores_.jobs, who.tenant, job_id);
  ReportContent content;
  content.provenance = collectProvenance(who, job);
  content.results = &results;
  for (const FigureInfo& info : functions_.list(results)) {
    content.figures.push_back(functions_.make(results, info.name));
  }
  for (NamedImage& named : paintInstants(who, job_id)) {
    content.images.push_back(std::move(named.image));
  }
  return cache_.put(tag, {"text/html", functions_.render_report(content)})->bytes;
}

std::vector<NamedImage> ReportService::paintInstants(const api::Identity& who,
                                                     const std::string& job_id) {
  const StoredResults results(stores_.jobs, who.tenant, job_id);
  std::vector<NamedImage> painted;
  if (!results.has("kinematics", ResultSource::Axis::kTime)) {
    return painted;
  }
  for (const ReportInstant& instant : functions_.find_instants(results)) {
    api::ImageRequest request;
    request.time = instant.time;
    request.width = kReportPoseWidth;
    request.height = kReportPoseHeight;
    const api::ImageFile image = images_.paint(who, job_id, request);
    painted.push_back(
        {makeImageName(instant.name),
         {makeImageCaption(instant), image.content_type, api::readAll(*image.bytes, kMaxImage)}});
  }
  return painted;
}

ReportProvenance ReportService::collectProvenance(const api::Identity& who,
                                                  const api::JobView& job) {
  ReportProvenance provenance;
  provenance.job_id = job.id;
  provenance.created_at = api::formatTimestamp(job.submitted_at);
  provenance.finished_at = job.finished_at ? api::formatTimestamp(*job.finished_at) : "";
  provenance.subject = job.subject;
  provenance.label = job.label;
  provenance.model = job.model_id;
  provenance.settings_name = job.settings_name;
  provenance.provenance = job.provenance;
  provenance.version = sourceVersion();
  bool brings_model = false;
  for (const api::UnderstoodFile& file : stores_.trials.find(who.tenant, job.trial_id).files) {
    provenance.inputs.push_back({file.part, file.name, file.size, file.sha256});
    brings_model = brings_model || file.part == "model";
  }
  if (provenance.model.empty()) {
    provenance.model = brings_model ? "the trial's own" : ShippedCatalog::kDefaultModel;
  }
  return provenance;
}

}  // namespace gaitmill

#include "service/compare_service.h"

#include <utility>

#include "core/base/error.h"
#include "service/job_tag.h"

namespace gaitmill {

CompareService::CompareService(Stores& stores, FigureFunctions functions)
    : stores_(stores), functions_(std::move(functions)) {}

// Names of the jobs are in the legends, so that equal results of other jobs are another figure.
std::string CompareService::findTag(const api::Identity& who,
                                    const std::vector<std::string>& job_ids) {
  std::vector<std::string> texts = {"comparison"};
  for (const std::string& id : job_ids) {
    texts.push_back(id);
    texts.push_back(identifyResults(stores_.jobs.find(who.tenant, id)));
  }
  return makeTag(texts);
}

api::ComparisonView CompareService::compare(const api::Identity& who,
                                            const std::vector<std::string>& job_ids) {
  const Opened opened = open(who, job_ids);
  return {functions_.compare(opened.jobs), functions_.list_overlays(opened.jobs)};
}

Figure CompareService::find(const api::Identity& who,
                            const std::vector<std::string>& job_ids,
                            const std::string& name) {
  return functions_.make_overlay(open(who, job_ids).jobs, name);
}

CompareService::Opened CompareService::open(const api::Identity& who,
                                            const std::vector<std::string>& job_ids) {
  Opened opened;
  for (const std::string& id : job_ids) {
    const api::JobView job = stores_.jobs.find(who.tenant, id);
    require(
        job.state == api::JobState::kSucceeded,
        ErrorCode::kResultNotReady,
        "jobs are compared when they have succeeded; " + id + " is " + api::jobStateName(job.state),
        {"", 0, 0, "jobs"});
    opened.results.push_back(std::make_unique<StoredResults>(stores_.jobs, who.tenant, id));
    opened.jobs.push_back({job.label.empty() ? id : job.label, opened.results.back().get()});
  }
  return opened;
}

}  // namespace gaitmill

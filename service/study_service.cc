#include "service/study_service.h"

#include <utility>

#include "core/base/error.h"

namespace gaitmill {

StudyService::StudyService(Stores& stores,
                           JobComposer& composer,
                           WorkerSignals workers,
                           const Quota& quota)
    : stores_(stores), composer_(composer), workers_(std::move(workers)), quota_(quota) {}

api::StudyView StudyService::submit(const api::Identity& who, const api::StudyRequest& request) {
  require(!request.jobs.empty() && request.jobs.size() <= kMaxJobs,
          ErrorCode::kRequestField,
          "a study has 1 to " + std::to_string(kMaxJobs) + " jobs, this one would have " +
              std::to_string(request.jobs.size()),
          {"", 0, 0, "trials"});
  NewStudy study;
  study.tenant = who.tenant;
  study.key_id = who.key_id;
  study.name = request.name;
  study.label = request.label;
  if (!request.submission_key.empty()) {
    study.submission_key = who.key_id + ":" + request.submission_key;
  }
  for (const api::JobRequest& job : request.jobs) {
    study.jobs.push_back(composer_.compose(who, job));
  }
  const std::string id = stores_.studies.submit(study, quota_);
  workers_.wake();
  return stores_.studies.find(who.tenant, id);
}

api::Page<api::StudyView> StudyService::list(const api::Identity& who,
                                             const api::ListFilter& filter,
                                             const api::PageRequest& page) {
  return stores_.studies.list(who.tenant, filter, page);
}

api::StudyView StudyService::find(const api::Identity& who, const std::string& study_id) {
  return stores_.studies.find(who.tenant, study_id);
}

std::vector<api::StudyRow> StudyService::listRows(const api::Identity& who,
                                                  const std::string& study_id) {
  return stores_.studies.listRows(who.tenant, study_id);
}

api::StudyView StudyService::cancel(const api::Identity& who, const std::string& study_id) {
  for (const std::string& job_id : stores_.studies.requestCancel(who.tenant, study_id)) {
    workers_.cancel(job_id);
  }
  return stores_.studies.find(who.tenant, study_id);
}

void StudyService::remove(const api::Identity& who, const std::string& study_id) {
  stores_.studies.remove(who.tenant, study_id);
}

}  // namespace gaitmill

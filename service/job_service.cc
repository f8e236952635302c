#include "service/job_service.h"

#include <utility>

namespace gaitmill {

JobService::JobService(Stores& stores,
                       JobComposer& composer,
                       JobEstimates& estimates,
                       WorkerSignals workers,
                       const Quota& quota)
    : stores_(stores),
      composer_(composer),
      estimates_(estimates),
      workers_(std::move(workers)),
      quota_(quota) {}

api::JobView JobService::submit(const api::Identity& who, const api::JobRequest& request) {
  const std::string id = stores_.jobs.submit(composer_.compose(who, request), quota_);
  workers_.wake();
  return find(who, id);
}

api::Page<api::JobView> JobService::list(const api::Identity& who,
                                         const api::ListFilter& filter,
                                         const api::PageRequest& page) {
  api::Page<api::JobView> jobs = stores_.jobs.list(who.tenant, filter, page);
  for (api::JobView& job : jobs.items) {
    job.seconds_left = estimates_.calcSecondsLeft(job);
  }
  return jobs;
}

api::JobView JobService::find(const api::Identity& who, const std::string& job_id) {
  api::JobView job = stores_.jobs.find(who.tenant, job_id);
  job.seconds_left = estimates_.calcSecondsLeft(job);
  return job;
}

// Stored first, so that a restart in between does not forget it; then the worker is told.
api::JobView JobService::cancel(const api::Identity& who, const std::string& job_id) {
  stores_.jobs.requestCancel(who.tenant, job_id);
  workers_.cancel(job_id);
  return find(who, job_id);
}

void JobService::remove(const api::Identity& who, const std::string& job_id) {
  stores_.jobs.remove(who.tenant, job_id);
}

std::vector<api::JobEvent> JobService::listEvents(const api::Identity& who,
                                                  const std::string& job_id,
                                                  std::int64_t after) {
  return stores_.jobs.listEvents(who.tenant, job_id, after);
}

}  // namespace gaitmill

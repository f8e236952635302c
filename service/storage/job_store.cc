#include "service/storage/job_store.h"

#include <algorithm>
#include <utility>

#include "service/storage/clock.h"
#include "service/storage/job_rows.h"
#include "service/storage/list_query.h"
#include "service/storage/sql/jobs.h"
#include "service/storage/sql/usage.h"

namespace gaitmill {

namespace {

using api::JobState;

constexpr JobState kAllStates[] = {JobState::kQueued,
                                   JobState::kRunning,
                                   JobState::kSucceeded,
                                   JobState::kFailed,
                                   JobState::kCancelled};

void requireKnownState(const std::string& name) {
  const bool is_known = std::any_of(std::begin(kAllStates), std::end(kAllStates), [&](auto state) {
    return name == api::jobStateName(state);
  });
  require(name.empty() || is_known,
          ErrorCode::kRequestField,
          "'" + name + "' is no state; there are queued, running, succeeded, failed and cancelled",
          {"", 0, 0, "state"});
}

// One pass over the queue for a whole page.
void countAheadOfAll(Connection& db, std::vector<api::JobView>& jobs) {
  const auto newest = std::find_if(jobs.begin(), jobs.end(), [](const api::JobView& job) {
    return job.state == JobState::kQueued;
  });
  if (newest == jobs.end()) {
    return;
  }
  std::vector<std::string> queue;
  Statement rows = db.prepare(sql::kListQueued);
  rows.bind(1, newest->id);
  while (rows.step()) {
    queue.push_back(rows.text(0));
  }
  for (api::JobView& job : jobs) {
    if (job.state == JobState::kQueued) {
      job.jobs_ahead = std::lower_bound(queue.begin(), queue.end(), job.id) - queue.begin();
    }
  }
}

}  // namespace

void JobStore::announce(const std::vector<JobChange>& changes) const {
  if (listener_) {
    for (const JobChange& change : changes) {
      listener_(change);
    }
  }
}

std::string JobStore::submit(const NewJob& job, const Quota& quota) {
  const AddedJob added =
      database_.write([&](Connection& db) { return addJob(db, job, "", quota); });
  announce(added.changes);
  return added.id;
}

api::JobView JobStore::find(const std::string& tenant, const std::string& job_id) {
  const ReadTransaction db = database_.read();
  Statement row = db->prepare(sql::kFindJob);
  if (!row.bind(1, job_id).bind(2, tenant).step()) {
    throw jobNotFound(job_id);
  }
  api::JobView job = readJobRow(row);
  completeJob(*db, job);
  Statement settings = db->prepare(sql::kFindSettings);
  settings.bind(1, job_id).step();
  job.settings_json = settings.text(0);
  if (job.state == JobState::kQueued) {
    Statement ahead = db->prepare(sql::kCountAhead);
    ahead.bind(1, job_id).step();
    job.jobs_ahead = ahead.integer(0);
  }
  return job;
}

api::Page<api::JobView> JobStore::list(const std::string& tenant,
                                       const api::ListFilter& filter,
                                       const api::PageRequest& page) {
  requireKnownState(filter.state);
  ListQuery query(sql::kSelectJobs, tenant, kJobPrefix);
  query.where("study_id =", filter.study_id)
      .where("trial_id =", filter.trial_id)
      .whereNonEmpty("subject", filter.subject)
      .whereNonEmpty("label", filter.label)
      .where("state =", filter.state)
      .between(filter.created_after, filter.created_before)
      .page(page);
  std::vector<api::JobView> jobs;
  const ReadTransaction db = database_.read();
  {
    Statement rows = query.run(*db);
    while (rows.step()) {
      jobs.push_back(readJobRow(rows));
    }
  }
  api::Page<api::JobView> found = makePage(std::move(jobs), page);
  for (api::JobView& job : found.items) {
    completeJob(*db, job);
  }
  countAheadOfAll(*db, found.items);
  return found;
}

void JobStore::remove(const std::string& tenant, const std::string& job_id) {
  const std::string study_id = database_.writeBulk([&](Connection& db) {
    const JobStanding standing = requireJob(db, tenant, job_id);
    require(api::isFinal(standing.state),
            ErrorCode::kJobState,
            std::string("the job is ") + api::jobStateName(standing.state) +
                "; cancel it before it is deleted",
            {"", 0, 0, "state"});
    dropJob(db, job_id, standing);
    return standing.study_id;
  });
  database_.wipeDeleted();
  announce({{lastChange(), job_id, study_id}});
}

void JobStore::requestCancel(const std::string& tenant, const std::string& job_id) {
  std::vector<JobChange> changes;
  database_.write([&](Connection& db) {
    const JobStanding standing = requireJob(db, tenant, job_id);
    require(standing.state != JobState::kSucceeded && standing.state != JobState::kFailed,
            ErrorCode::kJobState,
            std::string("the job has already ") + api::jobStateName(standing.state),
            {"", 0, 0, "state"});
    cancelJob(db, job_id, standing, changes);
  });
  announce(changes);
}

std::vector<api::JobEvent> JobStore::listEvents(const std::string& tenant,
                                                const std::string& job_id,
                                                std::int64_t after,
                                                int limit) {
  const ReadTransaction db = database_.read();
  if (!db->prepare(sql::kJobExists).bind(1, job_id).bind(2, tenant).step()) {
    throw jobNotFound(job_id);
  }
  std::vector<api::JobEvent> events;
  Statement rows = db->prepare(sql::kListEvents);
  rows.bind(1, job_id).bind(2, after).bind(3, std::int64_t{limit});
  while (rows.step()) {
    events.push_back({rows.integer(0), rows.integer(1), rows.text(2), rows.text(3)});
  }
  return events;
}

std::int64_t JobStore::lastChange() {
  const ReadTransaction db = database_.read();
  Statement row = db->prepare(sql::kFindCount);
  row.bind(1, "jobs").step();
  return row.integer(0);
}

std::vector<JobChange> JobStore::listChanges(std::int64_t since) {
  std::vector<JobChange> changes;
  const ReadTransaction db = database_.read();
  Statement rows = db->prepare(sql::kListChanges);
  rows.bind(1, since);
  while (rows.step()) {
    changes.push_back({rows.integer(0), rows.text(1), rows.text(2)});
  }
  return changes;
}

QueueStatistics JobStore::calcStatistics() {
  QueueStatistics statistics;
  for (const JobState state : kAllStates) {
    statistics.jobs[api::jobStateName(state)] = 0;
  }
  const ReadTransaction db = database_.read();
  Statement counts = db->prepare(sql::kCountByState);
  while (counts.step()) {
    statistics.jobs[counts.text(0)] = counts.integer(1);
  }
  Statement lapsed = db->prepare(sql::kCountLapsed);
  lapsed.bind(1, nowMilliseconds()).step();
  statistics.depth = statistics.jobs["queued"] + lapsed.integer(0);
  Statement oldest = db->prepare(sql::kFindOldestQueuedTime);
  if (oldest.step()) {
    statistics.oldest_queued_at = oldest.integer(0);
  }
  return statistics;
}

std::vector<StageEstimate> JobStore::calcStageEstimates() {
  std::vector<StageEstimate> estimates;
  const ReadTransaction db = database_.read();
  Statement rows = db->prepare(sql::kEstimateStages);
  while (rows.step()) {
    estimates.push_back({rows.text(0), rows.real(1), rows.real(2)});
  }
  return estimates;
}

std::vector<OwnedId> JobStore::listFinished(std::int64_t time, int limit) {
  std::vector<OwnedId> jobs;
  const ReadTransaction db = database_.read();
  Statement rows = db->prepare(sql::kListFinished);
  rows.bind(1, time).bind(2, std::int64_t{limit});
  while (rows.step()) {
    jobs.push_back({rows.text(0), rows.text(1)});
  }
  return jobs;
}

}  // namespace gaitmill

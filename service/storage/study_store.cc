#include "service/storage/study_store.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/base/error.h"
#include "service/storage/ids.h"
#include "service/storage/job_rows.h"
#include "service/storage/list_query.h"
#include "service/storage/sql/jobs.h"
#include "service/storage/sql/studies.h"

namespace gaitmill {

namespace {

using api::JobState;

constexpr const char* kPrefix = "stu_";

Error notFound(const std::string& study_id) {
  return {ErrorCode::kStudyNotFound, "there is no study '" + study_id + "'", {"", 0, 0, "study"}};
}

void requireStudy(Connection& db, const std::string& tenant, const std::string& study_id) {
  if (!db.prepare(sql::kFindStudy).bind(1, study_id).bind(2, tenant).step()) {
    throw notFound(study_id);
  }
}

api::StudyView readStudyRow(const Statement& row) {
  api::StudyView study;
  study.id = row.text(0);
  study.name = row.text(1);
  study.created_at = row.integer(2);
  study.version = row.integer(3);
  return study;
}

std::map<std::string, std::vector<api::StageTiming>> listStages(Connection& db,
                                                                const std::string& study_id) {
  std::map<std::string, std::vector<api::StageTiming>> stages;
  Statement rows = db.prepare(sql::kListStudyStages);
  rows.bind(1, study_id);
  while (rows.step()) {
    stages[rows.text(0)].push_back({rows.text(1), rows.real(2), rows.real(3)});
  }
  return stages;
}

// Adds the jobs' numbers by state, their progress, and their last change as the version.
void completeStudy(Connection& db, api::StudyView& study) {
  for (const JobState state : {JobState::kQueued,
                               JobState::kRunning,
                               JobState::kSucceeded,
                               JobState::kFailed,
                               JobState::kCancelled}) {
    study.jobs[api::jobStateName(state)] = 0;
  }
  auto stages = listStages(db, study.id);
  Statement rows = db.prepare(sql::kListStudyStanding);
  rows.bind(1, study.id);
  double progress = 0;
  while (rows.step()) {
    api::JobView job;
    job.id = rows.text(0);
    job.state = api::findJobState(rows.text(1));
    job.stages = std::move(stages[job.id]);
    study.version = std::max(study.version, rows.integer(2));
    ++study.jobs[rows.text(1)];
    progress += api::isFinal(job.state) ? 1.0 : api::calcJobProgress(job);
    study.job_ids.push_back(std::move(job.id));
  }
  const auto count = static_cast<double>(study.job_ids.size());
  study.progress = count > 0 ? progress / count : 1.0;
}

std::string addStudy(Connection& db,
                     const NewStudy& study,
                     const Quota& quota,
                     std::vector<JobChange>& changes) {
  if (!study.submission_key.empty()) {
    Statement earlier = db.prepare(sql::kFindStudyBySubmission);
    if (earlier.bind(1, study.tenant).bind(2, study.submission_key).step()) {
      return earlier.text(0);
    }
  }
  const std::string id = makeId(kPrefix);
  db.prepare(sql::kAddStudy)
      .bind(1, id)
      .bind(2, study.tenant)
      .bind(3, study.key_id)
      .bind(4, study.name)
      .bind(5, study.label)
      .bind(6, findTimeOfId(id))
      .bind(7, study.submission_key)
      .run();
  for (const NewJob& job : study.jobs) {
    check(job.tenant == study.tenant, "a study's job belongs to another tenant");
    const AddedJob added = addJob(db, job, id, quota);
    changes.insert(changes.end(), added.changes.begin(), added.changes.end());
  }
  return id;
}

std::vector<std::string> listJobIds(Connection& db, const std::string& study_id) {
  std::vector<std::string> ids;
  Statement rows = db.prepare(sql::kListStudyStanding);
  rows.bind(1, study_id);
  while (rows.step()) {
    ids.push_back(rows.text(0));
  }
  return ids;
}

}  // namespace

std::string StudyStore::submit(const NewStudy& study, const Quota& quota) {
  std::vector<JobChange> changes;
  const std::string id =
      database_.write([&](Connection& db) { return addStudy(db, study, quota, changes); });
  jobs_.announce(changes);
  return id;
}

api::StudyView StudyStore::find(const std::string& tenant, const std::string& study_id) {
  const ReadTransaction db = database_.read();
  Statement row = db->prepare(sql::kFindStudy);
  if (!row.bind(1, study_id).bind(2, tenant).step()) {
    throw notFound(study_id);
  }
  api::StudyView study = readStudyRow(row);
  completeStudy(*db, study);
  return study;
}

api::Page<api::StudyView> StudyStore::list(const std::string& tenant,
                                           const api::ListFilter& filter,
                                           const api::PageRequest& page) {
  ListQuery query(sql::kSelectStudies, tenant, kPrefix);
  query.whereNonEmpty("label", filter.label)
      .between(filter.created_after, filter.created_before)
      .page(page);
  std::vector<api::StudyView> studies;
  const ReadTransaction db = database_.read();
  {
    Statement rows = query.run(*db);
    while (rows.step()) {
      studies.push_back(readStudyRow(rows));
    }
  }
  api::Page<api::StudyView> found = makePage(std::move(studies), page);
  for (api::StudyView& study : found.items) {
    completeStudy(*db, study);
  }
  return found;
}

std::vector<api::StudyRow> StudyStore::listRows(const std::string& tenant,
                                                const std::string& study_id) {
  std::vector<api::StudyRow> rows;
  {
    const ReadTransaction db = database_.read();
    requireStudy(*db, tenant, study_id);
    {
      Statement jobs = db->prepare(sql::kListStudyJobs);
      jobs.bind(1, study_id);
      while (jobs.step()) {
        rows.push_back({readJobRow(jobs), ""});
      }
    }
    for (api::StudyRow& row : rows) {
      completeJob(*db, row.job);
    }
  }
  for (api::StudyRow& row : rows) {
    if (row.job.state == JobState::kSucceeded) {
      row.quality_json =
          jobs_.readResult(tenant, row.job.id, ResultKind::kSummary, "quality").bytes;
    }
  }
  return rows;
}

std::vector<std::string> StudyStore::requestCancel(const std::string& tenant,
                                                   const std::string& study_id) {
  std::vector<JobChange> changes;
  std::vector<std::string> marked;
  database_.write([&](Connection& db) {
    requireStudy(db, tenant, study_id);
    for (const std::string& job_id : listJobIds(db, study_id)) {
      if (cancelJob(db, job_id, findJobStanding(db, job_id).value(), changes)) {
        marked.push_back(job_id);
      }
    }
  });
  jobs_.announce(changes);
  return marked;
}

// Final jobs stay final, so that they may go one after the other: the study itself goes last, and a
// deletion that was cut off can be asked for again.
void StudyStore::remove(const std::string& tenant, const std::string& study_id) {
  std::vector<std::string> jobs;
  {
    const ReadTransaction db = database_.read();
    requireStudy(*db, tenant, study_id);
    jobs = listJobIds(*db, study_id);
    for (const std::string& job_id : jobs) {
      const JobState state = findJobStanding(*db, job_id).value().state;
      require(api::isFinal(state),
              ErrorCode::kJobState,
              "the job '" + job_id + "' of the study is " + api::jobStateName(state) +
                  "; cancel the study before it is deleted",
              {"", 0, 0, "state"});
    }
  }
  for (const std::string& job_id : jobs) {
    database_.writeBulk([&](Connection& db) {
      if (const auto standing = findJobStanding(db, job_id)) {
        dropJob(db, job_id, *standing);
      }
    });
  }
  database_.write([&](Connection& db) { db.prepare(sql::kDropStudy).bind(1, study_id).run(); });
  database_.wipeDeleted();
  for (const std::string& job_id : jobs) {
    jobs_.announce({{jobs_.lastChange(), job_id, study_id}});
  }
}

}  // namespace gaitmill

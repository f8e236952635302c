#include "service/storage/job_store.h"

#include <utility>

#include "api/dto/error_body.h"
#include "core/base/error.h"
#include "service/storage/clock.h"
#include "service/storage/ids.h"
#include "service/storage/job_states.h"
#include "service/storage/sha256.h"

namespace gaitmill {

namespace {

using api::JobState;

constexpr const char* kTrialExists = "SELECT 1 FROM trials WHERE id = ?1";
constexpr const char* kAddJob =
    "INSERT INTO jobs (id, trial_id, settings_name, settings, state, submitted_at) "
    "VALUES (?1, ?2, ?3, ?4, 'queued', ?5)";
constexpr const char* kFindJob =
    "SELECT trial_id, settings_name, state, claim, cancel_requested, submitted_at, started_at, "
    "finished_at, error FROM jobs WHERE id = ?1";
constexpr const char* kFindStages =
    "SELECT stage, seconds, fraction FROM job_stages WHERE job_id = ?1 ORDER BY position";
constexpr const char* kFindWarnings =
    "SELECT message FROM job_warnings WHERE job_id = ?1 ORDER BY position";
constexpr const char* kCountAhead = "SELECT count(*) FROM jobs WHERE state = 'queued' AND id < ?1";
constexpr const char* kFindState = "SELECT state, claim FROM jobs WHERE id = ?1";
constexpr const char* kFindQueued =
    "SELECT id, claim, trial_id, settings FROM jobs WHERE state = 'queued' ORDER BY id LIMIT 1";
constexpr const char* kClaim =
    "UPDATE jobs SET state = 'running', claim = claim + 1, started_at = ?2, finished_at = NULL "
    "WHERE id = ?1";
constexpr const char* kClearStages = "DELETE FROM job_stages WHERE job_id = ?1";
constexpr const char* kClearWarnings = "DELETE FROM job_warnings WHERE job_id = ?1";
constexpr const char* kPutStage =
    "INSERT INTO job_stages (job_id, position, stage, seconds, fraction) "
    "VALUES (?1, ?2, ?3, ?4, ?5) ON CONFLICT (job_id, position) DO UPDATE "
    "SET stage = excluded.stage, seconds = excluded.seconds, fraction = excluded.fraction";
constexpr const char* kAddWarning =
    "INSERT INTO job_warnings (job_id, position, message) "
    "SELECT ?1, count(*), ?2 FROM job_warnings WHERE job_id = ?1";
constexpr const char* kChangeState =
    "UPDATE jobs SET state = ?2, finished_at = ?3, error = ?4, deaths = deaths + ?5 "
    "WHERE id = ?1";
constexpr const char* kRequestCancel = "UPDATE jobs SET cancel_requested = 1 WHERE id = ?1";
constexpr const char* kFindRunning =
    "SELECT id, claim, cancel_requested, deaths FROM jobs WHERE state = 'running' ORDER BY id";
constexpr const char* kAddResult =
    "INSERT INTO results (job_id, kind, name, size, sha256, bytes) VALUES (?1, ?2, ?3, ?4, ?5, ?6)";
constexpr const char* kReadResult =
    "SELECT bytes, size, sha256 FROM results WHERE job_id = ?1 AND kind = ?2 AND name = ?3";
constexpr const char* kListFiles =
    "SELECT name, size, sha256 FROM results WHERE job_id = ?1 AND kind = 'file' ORDER BY name";

const char* kindName(ResultKind kind) {
  switch (kind) {
    case ResultKind::kFile:
      return "file";
    case ResultKind::kTime:
      return "time";
    case ResultKind::kCycle:
      return "cycle";
    case ResultKind::kSummary:
      return "summary";
  }
  return "";
}

struct Standing {
  JobState state;
  std::int64_t claim;
};

Standing findStanding(Connection& db, const std::string& job_id) {
  Statement row = db.prepare(kFindState);
  require(row.bind(1, job_id).step(),
          ErrorCode::kJobNotFound,
          "there is no job '" + job_id + "'",
          {"", 0, 0, job_id});
  return {api::findJobState(row.text(0)), row.integer(1)};
}

bool holds(Connection& db, const JobTicket& ticket) {
  const Standing standing = findStanding(db, ticket.job_id);
  return standing.state == JobState::kRunning && standing.claim == ticket.claim;
}

std::vector<api::StageTiming> findStages(Connection& db, const std::string& job_id) {
  std::vector<api::StageTiming> stages;
  Statement rows = db.prepare(kFindStages);
  rows.bind(1, job_id);
  while (rows.step()) {
    stages.push_back({rows.text(0), rows.real(1), rows.real(2)});
  }
  return stages;
}

std::vector<std::string> findWarnings(Connection& db, const std::string& job_id) {
  std::vector<std::string> warnings;
  Statement rows = db.prepare(kFindWarnings);
  rows.bind(1, job_id);
  while (rows.step()) {
    warnings.push_back(rows.text(0));
  }
  return warnings;
}

std::int64_t countAhead(Connection& db, const std::string& job_id) {
  Statement row = db.prepare(kCountAhead);
  row.bind(1, job_id).step();
  return row.integer(0);
}

api::JobView findRow(Connection& db, const std::string& job_id) {
  Statement row = db.prepare(kFindJob);
  require(row.bind(1, job_id).step(),
          ErrorCode::kJobNotFound,
          "there is no job '" + job_id + "'",
          {"", 0, 0, job_id});
  api::JobView job;
  job.id = job_id;
  job.trial_id = row.text(0);
  job.settings_name = row.text(1);
  job.state = api::findJobState(row.text(2));
  job.attempt = static_cast<int>(row.integer(3));
  job.cancel_requested = row.integer(4) != 0;
  job.submitted_at = row.integer(5);
  job.started_at = row.optionalInteger(6);
  job.finished_at = row.optionalInteger(7);
  job.error = row.optionalText(8);
  return job;
}

void addResults(Connection& db, const std::string& job_id, const std::vector<ResultItem>& results) {
  for (const ResultItem& item : results) {
    db.prepare(kAddResult)
        .bind(1, job_id)
        .bind(2, std::string(kindName(item.kind)))
        .bind(3, item.name)
        .bind(4, static_cast<std::int64_t>(item.bytes.size()))
        .bind(5, calcSha256(item.bytes))
        .bindBytes(6, item.bytes)
        .run();
  }
}

std::string describeAbandoned() {
  return api::renderErrorObject(Error(ErrorCode::kJobAbandoned,
                                      "the service died " + std::to_string(JobStore::kMaxDeaths) +
                                          " times while it ran this job; it is not tried again"));
}

}  // namespace

std::string JobStore::submit(const std::string& trial_id,
                             const std::string& settings_name,
                             const std::string& settings_json) {
  Connection& db = database_.connection();
  Transaction transaction(db, database_.writers());
  require(db.prepare(kTrialExists).bind(1, trial_id).step(),
          ErrorCode::kTrialNotFound,
          "there is no trial '" + trial_id + "'",
          {"", 0, 0, "trial"});
  std::string job_id = makeId("job_");
  db.prepare(kAddJob)
      .bind(1, job_id)
      .bind(2, trial_id)
      .bind(3, settings_name)
      .bind(4, settings_json)
      .bind(5, nowMilliseconds())
      .run();
  transaction.commit();
  return job_id;
}

api::JobView JobStore::find(const std::string& job_id) {
  Connection& db = database_.connection();
  api::JobView job = findRow(db, job_id);
  job.stages = findStages(db, job_id);
  job.warnings = findWarnings(db, job_id);
  if (job.state == JobState::kQueued) {
    job.jobs_ahead = countAhead(db, job_id);
  }
  return job;
}

std::optional<ClaimedJob> JobStore::claimNext() {
  Connection& db = database_.connection();
  Transaction transaction(db, database_.writers());
  ClaimedJob job;
  {
    Statement row = db.prepare(kFindQueued);
    if (!row.step()) {
      return std::nullopt;
    }
    job = {{row.text(0), row.integer(1) + 1}, row.text(2), row.text(3)};
  }
  db.prepare(kClaim).bind(1, job.ticket.job_id).bind(2, nowMilliseconds()).run();
  db.prepare(kClearStages).bind(1, job.ticket.job_id).run();
  db.prepare(kClearWarnings).bind(1, job.ticket.job_id).run();
  transaction.commit();
  return job;
}

bool JobStore::saveProgress(const JobTicket& ticket,
                            const std::vector<api::StageTiming>& stages,
                            const std::vector<std::string>& new_warnings) {
  Connection& db = database_.connection();
  Transaction transaction(db, database_.writers());
  if (!holds(db, ticket)) {
    return false;
  }
  std::int64_t position = 0;
  for (const api::StageTiming& stage : stages) {
    db.prepare(kPutStage)
        .bind(1, ticket.job_id)
        .bind(2, position++)
        .bind(3, stage.stage)
        .bind(4, stage.seconds)
        .bind(5, stage.fraction)
        .run();
  }
  for (const std::string& message : new_warnings) {
    db.prepare(kAddWarning).bind(1, ticket.job_id).bind(2, message).run();
  }
  transaction.commit();
  return true;
}

// Within the caller's transaction.
bool JobStore::change(Connection& db, const JobTicket& ticket, const Change& change) {
  const Standing standing = findStanding(db, ticket.job_id);
  if (standing.claim != ticket.claim || !isAllowedChange(standing.state, change.to)) {
    return false;
  }
  Statement update = db.prepare(kChangeState);
  update.bind(1, ticket.job_id).bind(2, std::string(api::jobStateName(change.to)));
  if (api::isFinal(change.to)) {
    update.bind(3, nowMilliseconds());
  }
  update.bind(4, change.error).bind(5, std::int64_t{change.died ? 1 : 0}).run();
  return true;
}

bool JobStore::changeAlone(const JobTicket& ticket, const Change& wanted) {
  Connection& db = database_.connection();
  Transaction transaction(db, database_.writers());
  const bool changed = change(db, ticket, wanted);
  transaction.commit();
  return changed;
}

bool JobStore::succeed(const JobTicket& ticket, const std::vector<ResultItem>& results) {
  Connection& db = database_.connection();
  Transaction transaction(db, database_.writers());
  if (!change(db, ticket, {JobState::kSucceeded, std::nullopt})) {
    return false;
  }
  addResults(db, ticket.job_id, results);
  transaction.commit();
  return true;
}

bool JobStore::fail(const JobTicket& ticket, const std::string& error_json) {
  return changeAlone(ticket, {JobState::kFailed, error_json});
}

bool JobStore::cancelRunning(const JobTicket& ticket) {
  return changeAlone(ticket, {JobState::kCancelled, std::nullopt});
}

bool JobStore::requeue(const JobTicket& ticket) {
  return changeAlone(ticket, {JobState::kQueued, std::nullopt});
}

void JobStore::requestCancel(const std::string& job_id) {
  Connection& db = database_.connection();
  Transaction transaction(db, database_.writers());
  const Standing standing = findStanding(db, job_id);
  if (standing.state == JobState::kCancelled) {
    return;
  }
  require(!api::isFinal(standing.state),
          ErrorCode::kJobState,
          std::string("the job has already ") + api::jobStateName(standing.state),
          {"", 0, 0, job_id});
  db.prepare(kRequestCancel).bind(1, job_id).run();
  if (standing.state == JobState::kQueued) {
    change(db, {job_id, standing.claim}, {JobState::kCancelled, std::nullopt});
  }
  transaction.commit();
}

Recovery JobStore::recover() {
  struct Orphan {
    JobTicket ticket;
    bool cancel_requested;
    std::int64_t deaths;
  };
  Connection& db = database_.connection();
  Transaction transaction(db, database_.writers());
  std::vector<Orphan> orphans;
  {
    Statement rows = db.prepare(kFindRunning);
    while (rows.step()) {
      orphans.push_back({{rows.text(0), rows.integer(1)}, rows.integer(2) != 0, rows.integer(3)});
    }
  }
  Recovery recovery;
  for (const Orphan& orphan : orphans) {
    if (orphan.cancel_requested) {
      recovery.cancelled += change(db, orphan.ticket, {JobState::kCancelled, {}, true}) ? 1 : 0;
    } else if (orphan.deaths + 1 >= kMaxDeaths) {
      recovery.abandoned +=
          change(db, orphan.ticket, {JobState::kFailed, describeAbandoned(), true}) ? 1 : 0;
    } else {
      recovery.requeued += change(db, orphan.ticket, {JobState::kQueued, {}, true}) ? 1 : 0;
    }
  }
  transaction.commit();
  return recovery;
}

void JobStore::requireSucceeded(const std::string& job_id) {
  const Standing standing = findStanding(database_.connection(), job_id);
  require(standing.state == JobState::kSucceeded,
          ErrorCode::kResultNotReady,
          std::string("results exist when the job has succeeded; it is ") +
              api::jobStateName(standing.state),
          {"", 0, 0, job_id});
}

std::string JobStore::readResult(const std::string& job_id,
                                 ResultKind kind,
                                 const std::string& name) {
  requireSucceeded(job_id);
  Statement row = database_.connection().prepare(kReadResult);
  row.bind(1, job_id).bind(2, std::string(kindName(kind))).bind(3, name);
  require(row.step(),
          ErrorCode::kResultNotFound,
          "this job has no result '" + name + "' of this kind",
          {"", 0, 0, name});
  std::string bytes = row.bytes(0);
  require(calcSha256(bytes) == row.text(2),
          ErrorCode::kStorage,
          "a stored result does not have its hash any more",
          {"", 0, 0, name});
  return bytes;
}

std::vector<api::FileView> JobStore::listFiles(const std::string& job_id) {
  requireSucceeded(job_id);
  std::vector<api::FileView> files;
  Statement rows = database_.connection().prepare(kListFiles);
  rows.bind(1, job_id);
  while (rows.step()) {
    files.push_back({rows.text(0), rows.integer(1), rows.text(2)});
  }
  return files;
}

api::FileContent JobStore::readFile(const std::string& job_id, const std::string& name) {
  std::string bytes = readResult(job_id, ResultKind::kFile, name);
  const auto size = static_cast<std::int64_t>(bytes.size());
  std::string hash = calcSha256(bytes);
  return {{name, size, std::move(hash)}, std::move(bytes)};
}

}  // namespace gaitmill

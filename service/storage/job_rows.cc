#include "service/storage/job_rows.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "api/dto/object_reader.h"
#include "api/errors.h"
#include "service/storage/clock.h"
#include "service/storage/ids.h"
#include "service/storage/job_states.h"
#include "service/storage/sql/jobs.h"
#include "service/storage/sql/studies.h"
#include "service/storage/usage_rows.h"

namespace gaitmill {

namespace {

using api::JobState;

ErrorCode findCode(const std::string& name) {
  for (const ErrorCode code : allErrorCodes()) {
    if (codeName(code) == name) {
      return code;
    }
  }
  return ErrorCode::kInternal;
}

// Jobs that failed under version 3 keep {"code", "message", "where"}: no problem details yet.
std::string renderStoredError(const std::string& text) {
  const nlohmann::json stored = nlohmann::json::parse(text);
  if (!stored.contains("message")) {
    return text;
  }
  const nlohmann::json where = stored.value("where", nlohmann::json::object());
  return api::renderProblemObject(Error(findCode(stored.value("code", "")),
                                        stored.value("message", ""),
                                        {where.value("file", ""),
                                         where.value("line", 0),
                                         where.value("column", 0),
                                         where.value("field", "")}));
}

std::optional<std::string> orNothing(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

std::optional<std::string> findSubmittedJob(Connection& db, const NewJob& job) {
  Statement row = db.prepare(sql::kFindJobBySubmission);
  row.bind(1, job.tenant).bind(2, job.submission_key);
  return !job.submission_key.empty() && row.step() ? std::optional(row.text(0)) : std::nullopt;
}

std::string requireSubject(Connection& db, const NewJob& job) {
  Statement row = db.prepare(sql::kFindTrialSubject);
  require(row.bind(1, job.trial_id).bind(2, job.tenant).step(),
          ErrorCode::kTrialNotFound,
          "there is no trial '" + job.trial_id + "'",
          {"", 0, 0, "trial"});
  return row.text(0);
}

// Shipped models are files, named without the prefix.
void requireModel(Connection& db, const NewJob& job) {
  require(!isId(job.model_id, "mod_") ||
              db.prepare(sql::kCatalogHas).bind(1, job.model_id).bind(2, job.tenant).step(),
          ErrorCode::kModelNotFound,
          "there is no model '" + job.model_id + "'",
          {"", 0, 0, "model"});
}

void insertJob(Connection& db,
               const std::string& id,
               const NewJob& job,
               const std::string& study_id,
               const std::string& subject) {
  db.prepare(sql::kAddJob)
      .bind(1, id)
      .bind(2, job.trial_id)
      .bind(3, job.settings_name)
      .bind(4, findTimeOfId(id))
      .bind(5, job.tenant)
      .bind(6, job.key_id)
      .bind(7, orNothing(study_id))
      .bind(8, job.model_id)
      .bind(9, job.label)
      .bind(10, subject)
      .bind(11, job.provenance)
      .bind(12, job.frames)
      .bind(13, job.pixels)
      .bind(14, job.submission_key)
      .run();
  db.prepare(sql::kAddSettings).bind(1, id).bind(2, job.settings_json).run();
}

Error describeLastDeath(const Error& reason, std::int64_t deaths) {
  Error error(reason.code(),
              std::to_string(deaths) + " attempts at this job have died, the last one: " +
                  reason.message() + "; it is not tried again",
              reason.where());
  for (const std::string& step : reason.context()) {
    error.addContext(step);
  }
  return error;
}

}  // namespace

Error jobNotFound(const std::string& job_id) {
  return {ErrorCode::kJobNotFound, "there is no job '" + job_id + "'", {"", 0, 0, "job"}};
}

bool JobStanding::isHeldWith(std::int64_t ticket_claim) const {
  return state == JobState::kRunning && claim == ticket_claim && lease_until > 0;
}

std::optional<JobStanding> findJobStanding(Connection& db, const std::string& job_id) {
  Statement row = db.prepare(sql::kFindStanding);
  if (!row.bind(1, job_id).step()) {
    return std::nullopt;
  }
  JobStanding standing;
  standing.state = api::findJobState(row.text(0));
  standing.claim = row.integer(1);
  standing.lease_until = row.integer(2);
  standing.cancel_requested = row.integer(3) != 0;
  standing.deaths = row.integer(4);
  standing.owner = row.text(5);
  standing.study_id = row.text(6);
  standing.tenant = row.text(7);
  standing.key_id = row.text(8);
  standing.frames = row.integer(9);
  standing.pixels = row.integer(10);
  return standing;
}

JobStanding requireJob(Connection& db, const std::string& tenant, const std::string& job_id) {
  std::optional<JobStanding> standing = findJobStanding(db, job_id);
  if (!standing || standing->tenant != tenant) {
    throw jobNotFound(job_id);
  }
  return std::move(*standing);
}

api::JobView readJobRow(const Statement& row) {
  api::JobView job;
  job.id = row.text(0);
  job.trial_id = row.text(1);
  job.settings_name = row.text(2);
  job.state = api::findJobState(row.text(3));
  job.attempt = static_cast<int>(row.integer(4));
  job.cancel_requested = row.integer(5) != 0;
  job.submitted_at = row.integer(6);
  job.started_at = row.optionalInteger(7);
  job.finished_at = row.optionalInteger(8);
  if (const auto error = row.optionalText(9)) {
    job.error = renderStoredError(*error);
  }
  job.study_id = row.text(10);
  job.model_id = row.text(11);
  job.label = row.text(12);
  job.subject = row.text(13);
  job.version = row.integer(14);
  job.verdict = row.text(15);
  job.provenance = row.text(16);
  return job;
}

void completeJob(Connection& db, api::JobView& job) {
  Statement stages = db.prepare(sql::kListStages);
  stages.bind(1, job.id);
  while (stages.step()) {
    job.stages.push_back({stages.text(0), stages.real(1), stages.real(2)});
  }
  Statement warnings = db.prepare(sql::kListWarnings);
  warnings.bind(1, job.id);
  while (warnings.step()) {
    job.warnings.push_back(warnings.text(0));
  }
}

EventText makeStateEvent(JobState state, std::int64_t attempt) {
  nlohmann::json data = {{"state", api::jobStateName(state)}};
  if (state == JobState::kRunning) {
    data["attempt"] = attempt;
  }
  return {"state", api::dumpJson(data)};
}

JobChange recordEvents(Connection& db,
                       const std::string& job_id,
                       const std::vector<EventText>& events) {
  JobChange change{nextCount(db, "jobs"), job_id, ""};
  const auto count = static_cast<std::int64_t>(events.size());
  std::int64_t event_id = 0;
  {
    Statement row = db.prepare(sql::kRecordChange);
    row.bind(1, job_id).bind(2, count).bind(3, change.change).step();
    event_id = row.integer(0) - count;
    change.study_id = row.text(1);
  }
  const std::int64_t now = nowMilliseconds();
  for (const EventText& event : events) {
    db.prepare(sql::kAddEvent)
        .bind(1, job_id)
        .bind(2, ++event_id)
        .bind(3, now)
        .bind(4, event.kind)
        .bind(5, event.data)
        .run();
  }
  return change;
}

AddedJob addJob(Connection& db,
                const NewJob& job,
                const std::string& study_id,
                const Quota& quota) {
  if (const auto earlier = findSubmittedJob(db, job)) {
    return {*earlier, {}};
  }
  const std::string subject = requireSubject(db, job);
  requireModel(db, job);
  const std::string id = makeId(kJobPrefix);
  insertJob(db, id, job, study_id, subject);
  chargeUsage(db, job.tenant, job.key_id, {0, 0, 1, job.frames, job.pixels}, quota);
  return {id, {recordEvents(db, id, {makeStateEvent(JobState::kQueued, 0)})}};
}

JobChange endJob(Connection& db,
                 const std::string& job_id,
                 const JobStanding& standing,
                 const JobEnd& end) {
  check(isAllowedChange(standing.state, end.state), "a job would change its state backwards");
  db.prepare(sql::kEnd)
      .bind(1, job_id)
      .bind(2, api::jobStateName(end.state))
      .bind(3, nowMilliseconds())
      .bind(4, end.error)
      .bind(5, end.verdict)
      .run();
  db.prepare(sql::kDropCheckpoints).bind(1, job_id).run();
  return recordEvents(db, job_id, {makeStateEvent(end.state, standing.claim)});
}

DeathRecord recordJobDeath(Connection& db,
                           const std::string& job_id,
                           const JobStanding& standing,
                           const Error& reason) {
  db.prepare(sql::kGiveBack)
      .bind(1, job_id)
      .bind(2, std::int64_t{1})
      .bind(3, std::optional(reason.message()))
      .run();
  if (standing.cancel_requested) {
    return {DeathOutcome::kCancelled,
            {endJob(db, job_id, standing, {JobState::kCancelled, {}, ""})}};
  }
  const std::int64_t deaths = standing.deaths + 1;
  if (deaths >= JobStore::kMaxDeaths) {
    const std::string error = api::renderProblemObject(describeLastDeath(reason, deaths));
    return {DeathOutcome::kFailed, {endJob(db, job_id, standing, {JobState::kFailed, error, ""})}};
  }
  return {DeathOutcome::kGivenBack, {}};
}

bool cancelJob(Connection& db,
               const std::string& job_id,
               const JobStanding& standing,
               std::vector<JobChange>& changes) {
  if (api::isFinal(standing.state)) {
    return false;
  }
  const bool is_held = standing.state == JobState::kRunning && standing.lease_until > 0;
  if (!standing.cancel_requested) {
    db.prepare(sql::kRequestCancel).bind(1, job_id).run();
  }
  if (!is_held) {
    changes.push_back(endJob(db, job_id, standing, {JobState::kCancelled, {}, ""}));
  } else if (!standing.cancel_requested) {
    changes.push_back(recordEvents(
        db,
        job_id,
        {{"state", api::dumpJson({{"state", "running"}, {"cancel_requested", true}})}}));
  }
  return is_held;
}

void dropJob(Connection& db, const std::string& job_id, const JobStanding& standing) {
  db.prepare(sql::kDropJob).bind(1, job_id).run();
  chargeUsage(db, standing.tenant, standing.key_id, {0, 0, -1, -standing.frames, -standing.pixels});
  if (!standing.study_id.empty()) {
    db.prepare(sql::kTouchStudy).bind(1, standing.study_id).bind(2, nextCount(db, "jobs")).run();
  }
}

}  // namespace gaitmill

#pragma once

#include <string>

namespace gaitmill::sql {

inline constexpr const char* kFindTrialSubject =
    "SELECT subject FROM trials WHERE id = ?1 AND tenant = ?2";
inline constexpr const char* kCatalogHas = "SELECT 1 FROM catalog WHERE id = ?1 AND tenant = ?2";
inline constexpr const char* kFindJobBySubmission =
    "SELECT id FROM jobs WHERE tenant = ?1 AND submission_key = ?2 AND submission_key <> ''";
inline constexpr const char* kAddJob =
    "INSERT INTO jobs (id, trial_id, settings_name, state, submitted_at, tenant, key_id, study_id, "
    "model_id, label, subject, provenance, frames, pixels, submission_key, version) "
    "VALUES (?1, ?2, ?3, 'queued', ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, 0)";
inline constexpr const char* kAddSettings =
    "INSERT INTO job_settings (job_id, document) VALUES (?1, ?2)";

/// Column order of job_rows.cc.
inline constexpr const char* kSelectJobs =
    "SELECT id, trial_id, settings_name, state, claim, cancel_requested, submitted_at, started_at, "
    "finished_at, error, study_id, model_id, label, subject, version, verdict, provenance "
    "FROM jobs";
inline const std::string kFindJob = std::string(kSelectJobs) + " WHERE id = ?1 AND tenant = ?2";
inline const std::string kListStudyJobs =
    std::string(kSelectJobs) + " WHERE study_id = ?1 ORDER BY id";
inline constexpr const char* kFindSettings = "SELECT document FROM job_settings WHERE job_id = ?1";
inline constexpr const char* kListStages =
    "SELECT stage, seconds, fraction FROM job_stages WHERE job_id = ?1 ORDER BY position";
inline constexpr const char* kListWarnings =
    "SELECT message FROM job_warnings WHERE job_id = ?1 ORDER BY position";
inline constexpr const char* kCountAhead =
    "SELECT count(*) FROM jobs WHERE state = 'queued' AND id < ?1";
inline constexpr const char* kListQueued =
    "SELECT id FROM jobs WHERE state = 'queued' AND id <= ?1 ORDER BY id";
inline constexpr const char* kFindStanding =
    "SELECT state, claim, lease_until, cancel_requested, deaths, owner, study_id, tenant, key_id, "
    "frames, pixels FROM jobs WHERE id = ?1";

inline constexpr const char* kAddPixels = "UPDATE jobs SET pixels = pixels + ?2 WHERE id = ?1";

inline constexpr const char* kClaim =
    "UPDATE jobs SET state = 'running', claim = claim + 1, owner = ?2, lease_until = ?3, "
    "started_at = coalesce(started_at, ?4) WHERE id = ?1";
inline constexpr const char* kReadClaimed =
    "SELECT tenant, trial_id, model_id, provenance, deaths, claim FROM jobs WHERE id = ?1";
inline constexpr const char* kDropUnfinishedStages =
    "DELETE FROM job_stages WHERE job_id = ?1 AND stage NOT IN "
    "(SELECT stage FROM checkpoints WHERE job_id = ?1)";
inline constexpr const char* kDropUnsettledWarnings =
    "DELETE FROM job_warnings WHERE job_id = ?1 AND settled = 0";
inline constexpr const char* kRenewLease = "UPDATE jobs SET lease_until = ?2 WHERE id = ?1";
inline constexpr const char* kGiveBack =
    "UPDATE jobs SET owner = '', lease_until = 0, deaths = deaths + ?2, "
    "last_death = coalesce(?3, last_death) WHERE id = ?1";
inline constexpr const char* kForgiveDeaths = "UPDATE jobs SET deaths = 0 WHERE id = ?1";
inline constexpr const char* kListHeldBy =
    "SELECT id, claim FROM jobs WHERE state = 'running' AND lease_until > 0 "
    "AND substr(owner, 1, length(?1)) = ?1 ORDER BY id";
inline constexpr const char* kRequestCancel = "UPDATE jobs SET cancel_requested = 1 WHERE id = ?1";
inline constexpr const char* kEnd =
    "UPDATE jobs SET state = ?2, finished_at = ?3, error = ?4, verdict = ?5, owner = '', "
    "lease_until = 0 WHERE id = ?1";
inline constexpr const char* kDropCheckpoints = "DELETE FROM checkpoints WHERE job_id = ?1";
inline constexpr const char* kDropJob = "DELETE FROM jobs WHERE id = ?1";

inline constexpr const char* kPutStage =
    "INSERT INTO job_stages (job_id, position, stage, seconds, fraction) "
    "VALUES (?1, ?2, ?3, ?4, ?5) ON CONFLICT (job_id, position) DO UPDATE "
    "SET stage = excluded.stage, seconds = excluded.seconds, fraction = excluded.fraction";
inline constexpr const char* kAddWarning =
    "INSERT INTO job_warnings (job_id, position, message) "
    "SELECT ?1, coalesce(max(position), -1) + 1, ?2 FROM job_warnings WHERE job_id = ?1";
inline constexpr const char* kSettleWarnings =
    "UPDATE job_warnings SET settled = 1 WHERE job_id = ?1";

inline constexpr const char* kRecordChange =
    "UPDATE jobs SET version = version + ?2, changed = ?3 WHERE id = ?1 "
    "RETURNING version, study_id";
inline constexpr const char* kAddEvent =
    "INSERT INTO job_events (job_id, id, at, kind, data) VALUES (?1, ?2, ?3, ?4, ?5)";
inline constexpr const char* kDropProgressEvents =
    "DELETE FROM job_events WHERE job_id = ?1 AND kind = 'progress'";
inline constexpr const char* kListEvents =
    "SELECT id, at, kind, data FROM job_events WHERE job_id = ?1 AND id > ?2 ORDER BY id LIMIT ?3";
inline constexpr const char* kJobExists = "SELECT state FROM jobs WHERE id = ?1 AND tenant = ?2";
inline constexpr const char* kListChanges =
    "SELECT changed, id, study_id FROM jobs WHERE changed > ?1 ORDER BY changed LIMIT 1000";

inline constexpr const char* kCountByState = "SELECT state, count(*) FROM jobs GROUP BY state";
inline constexpr const char* kCountLapsed =
    "SELECT count(*) FROM jobs WHERE state = 'running' AND lease_until <= ?1";
inline constexpr const char* kFindOldestQueuedTime =
    "SELECT submitted_at FROM jobs WHERE state = 'queued' ORDER BY id LIMIT 1";
inline constexpr const char* kEstimateStages =
    "WITH latest AS (SELECT id, frames FROM jobs WHERE state = 'succeeded' ORDER BY id DESC "
    "LIMIT 50) SELECT stage, avg(seconds), "
    "coalesce(avg(CASE WHEN frames > 0 THEN seconds / frames END), 0), min(position) "
    "FROM latest JOIN job_stages ON job_id = id GROUP BY stage ORDER BY 4, stage";
inline constexpr const char* kListFinished =
    "SELECT tenant, id FROM jobs WHERE finished_at IS NOT NULL AND finished_at < ?1 "
    "ORDER BY finished_at LIMIT ?2";

}  // namespace gaitmill::sql

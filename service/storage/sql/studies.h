#pragma once

namespace gaitmill::sql {

inline constexpr const char* kAddStudy =
    "INSERT INTO studies (id, tenant, key_id, name, label, created_at, submission_key) "
    "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)";
inline constexpr const char* kFindStudyBySubmission =
    "SELECT id FROM studies WHERE tenant = ?1 AND submission_key = ?2 AND submission_key <> ''";
inline constexpr const char* kSelectStudies = "SELECT id, name, created_at, changed FROM studies";
inline constexpr const char* kFindStudy =
    "SELECT id, name, created_at, changed FROM studies WHERE id = ?1 AND tenant = ?2";
inline constexpr const char* kListStudyStanding =
    "SELECT id, state, changed, study_id FROM jobs WHERE study_id = ?1 ORDER BY id";
inline constexpr const char* kListStudyStages =
    "SELECT job_id, stage, seconds, fraction FROM jobs JOIN job_stages ON job_id = id "
    "WHERE study_id = ?1 ORDER BY job_id, position";
inline constexpr const char* kTouchStudy = "UPDATE studies SET changed = ?2 WHERE id = ?1";
inline constexpr const char* kDropStudy = "DELETE FROM studies WHERE id = ?1";

}  // namespace gaitmill::sql

#pragma once

namespace gaitmill::sql {

inline constexpr const char* kAddTrial =
    "INSERT INTO trials (id, created_at, mass_kg, height_m, marker_set, options, understood, "
    "tenant, key_id, subject, label, bytes, submission_key) "
    "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13)";
inline constexpr const char* kSelectTrials =
    "SELECT id, created_at, mass_kg, height_m, marker_set, options, understood, subject, label "
    "FROM trials";
inline constexpr const char* kFindTrial =
    "SELECT id, created_at, mass_kg, height_m, marker_set, options, understood, subject, label "
    "FROM trials WHERE id = ?1 AND tenant = ?2";
inline constexpr const char* kFindTrialOwner =
    "SELECT key_id, bytes FROM trials WHERE id = ?1 AND tenant = ?2";
inline constexpr const char* kFindTrialBySubmission =
    "SELECT id FROM trials WHERE tenant = ?1 AND submission_key = ?2 AND submission_key <> ''";
inline constexpr const char* kChangeTrial =
    "UPDATE trials SET understood = ?2, bytes = bytes + ?3 WHERE id = ?1";
inline constexpr const char* kTrialHasJobs = "SELECT 1 FROM jobs WHERE trial_id = ?1 LIMIT 1";
inline constexpr const char* kDropTrial = "DELETE FROM trials WHERE id = ?1";
inline constexpr const char* kListUnusedTrials =
    "SELECT tenant, id FROM trials WHERE id < ?1 AND NOT EXISTS "
    "(SELECT 1 FROM jobs WHERE jobs.trial_id = trials.id) ORDER BY id LIMIT ?2";

inline constexpr const char* kPutTrialFile =
    "INSERT INTO trial_files (trial_id, part, name, blob_id) VALUES (?1, ?2, ?3, ?4) "
    "ON CONFLICT (trial_id, part) DO UPDATE SET name = excluded.name, blob_id = excluded.blob_id";
inline constexpr const char* kFindTrialFile =
    "SELECT name, blob_id, blobs.size, blobs.sha256 FROM trial_files "
    "JOIN blobs ON blobs.id = blob_id WHERE trial_id = ?1 AND part = ?2";
inline constexpr const char* kListTrialFiles =
    "SELECT part, name, blob_id, blobs.size FROM trial_files JOIN blobs ON blobs.id = blob_id "
    "WHERE trial_id = ?1 ORDER BY part";

}  // namespace gaitmill::sql

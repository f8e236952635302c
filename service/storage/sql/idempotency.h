#pragma once

namespace gaitmill::sql {

inline constexpr const char* kFindAnswer =
    "SELECT request_hash, status, content_type, location, body, created_at, owner "
    "FROM idempotency WHERE tenant = ?1 AND key = ?2";
inline constexpr const char* kBeginAnswer =
    "INSERT INTO idempotency (tenant, key, owner, created_at, request_hash, status, content_type, "
    "location, body) VALUES (?1, ?2, ?3, ?4, ?5, 0, '', '', '') ON CONFLICT (tenant, key) "
    "DO UPDATE SET owner = excluded.owner, created_at = excluded.created_at, "
    "request_hash = excluded.request_hash, status = 0, content_type = '', location = '', "
    "body = ''";
inline constexpr const char* kFinishAnswer =
    "UPDATE idempotency SET status = ?3, content_type = ?4, location = ?5, body = ?6 "
    "WHERE tenant = ?1 AND key = ?2";
inline constexpr const char* kAbandonAnswer =
    "DELETE FROM idempotency WHERE tenant = ?1 AND key = ?2 AND status = 0";
inline constexpr const char* kDropExpiredAnswers = "DELETE FROM idempotency WHERE created_at < ?1";

// What was stored under a key whose day is over: the next request with this key is a new one.
inline constexpr const char* kReleaseKey[] = {
    "UPDATE trials SET submission_key = '' "
    "WHERE tenant = ?1 AND submission_key = ?2 AND submission_key <> ''",
    "UPDATE jobs SET submission_key = '' "
    "WHERE tenant = ?1 AND submission_key = ?2 AND submission_key <> ''",
    "UPDATE studies SET submission_key = '' "
    "WHERE tenant = ?1 AND submission_key = ?2 AND submission_key <> ''",
    "UPDATE catalog SET submission_key = '' "
    "WHERE tenant = ?1 AND submission_key = ?2 AND submission_key <> ''",
};
inline constexpr const char* kReleaseExpiredKeys[] = {
    "UPDATE trials SET submission_key = '' WHERE submission_key <> '' AND created_at < ?1",
    "UPDATE jobs SET submission_key = '' WHERE submission_key <> '' AND submitted_at < ?1",
    "UPDATE studies SET submission_key = '' WHERE submission_key <> '' AND created_at < ?1",
    "UPDATE catalog SET submission_key = '' WHERE submission_key <> '' AND created_at < ?1",
};

}  // namespace gaitmill::sql

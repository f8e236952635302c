#pragma once

namespace gaitmill::sql {

inline constexpr const char* kPutResult =
    "INSERT INTO results (job_id, kind, name, stage, size, sha256, encoding, bytes) "
    "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8) ON CONFLICT (job_id, kind, name) DO UPDATE SET "
    "stage = excluded.stage, size = excluded.size, sha256 = excluded.sha256, "
    "encoding = excluded.encoding, bytes = excluded.bytes";
inline constexpr const char* kListResults =
    "SELECT kind, name, stage, size, sha256 FROM results WHERE job_id = ?1 ORDER BY kind, name";
inline constexpr const char* kReadResult =
    "SELECT stage, size, sha256, encoding, bytes FROM results "
    "WHERE job_id = ?1 AND kind = ?2 AND name = ?3";

inline constexpr const char* kPutCheckpoint =
    "INSERT INTO checkpoints (job_id, position, stage, size, sha256, encoding, bytes) "
    "SELECT ?1, count(*), ?2, ?3, ?4, ?5, ?6 FROM checkpoints WHERE job_id = ?1 "
    "ON CONFLICT (job_id, stage) DO UPDATE SET size = excluded.size, sha256 = excluded.sha256, "
    "encoding = excluded.encoding, bytes = excluded.bytes";
inline constexpr const char* kListCheckpoints =
    "SELECT stage, size, sha256, encoding, bytes FROM checkpoints WHERE job_id = ?1 "
    "ORDER BY position";

}  // namespace gaitmill::sql

#pragma once

namespace gaitmill::sql {

inline constexpr const char* kCharge =
    "INSERT INTO usage (tenant, key_id, bytes, trials, jobs, frames, pixels) "
    "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7) ON CONFLICT (tenant, key_id) DO UPDATE SET "
    "bytes = usage.bytes + excluded.bytes, trials = usage.trials + excluded.trials, "
    "jobs = usage.jobs + excluded.jobs, frames = usage.frames + excluded.frames, "
    "pixels = usage.pixels + excluded.pixels "
    "RETURNING bytes, trials, jobs, frames, pixels";
inline constexpr const char* kFindUsage =
    "SELECT bytes, trials, jobs, frames, pixels FROM usage WHERE tenant = ?1 AND key_id = ?2";
inline constexpr const char* kCount =
    "UPDATE counters SET value = value + 1 WHERE name = ?1 RETURNING value";
inline constexpr const char* kFindCount = "SELECT value FROM counters WHERE name = ?1";

}  // namespace gaitmill::sql

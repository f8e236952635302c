#pragma once

/// What the statements under sql/ do not share between databases, each with what PostgreSQL would
/// say instead. Everything else is SQL that both understand: ON CONFLICT, RETURNING, partial
/// indexes, ON DELETE CASCADE, numbered parameters.
///
///   placeholders     "?1"; a PostgreSQL connection rewrites them to "$1" when it prepares
///   numbers          INTEGER columns hold 64 bits: BIGINT in the migrations of PostgreSQL
///   bytes            BLOB: BYTEA there
///   identity         INTEGER PRIMARY KEY AUTOINCREMENT: BIGINT GENERATED ALWAYS AS IDENTITY
///   new row's id     RETURNING id, in both
///   row layout       WITHOUT ROWID: leave it out
///   change numbers   one writer at a time, so that they become visible in their order; PostgreSQL
///                    needs the row lock on counters that the UPDATE takes anyway
///   group commit     one writer thread: there each closure may have a connection of its own, and
///                    the server groups the commits
///   serving alone    a lock on a file beside the database: pg_try_advisory_lock
///   backup           the page copy of backup.cc: pg_dump
namespace gaitmill::dialect {

/// PostgreSQL: BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY
inline constexpr const char* kBeginRead = "BEGIN";
/// PostgreSQL: BEGIN. Here it takes the write lock at once, so that no batch fails half way.
inline constexpr const char* kBeginWrite = "BEGIN IMMEDIATE";
inline constexpr const char* kCommit = "COMMIT";
inline constexpr const char* kRollBack = "ROLLBACK";
inline constexpr const char* kSave = "SAVEPOINT piece";
inline constexpr const char* kRelease = "RELEASE piece";
inline constexpr const char* kRollBackToSave = "ROLLBACK TO piece";

/// The oldest job that waits in the queue. PostgreSQL: … FOR UPDATE SKIP LOCKED, for its writers
/// run side by side.
inline constexpr const char* kFindOldestQueued =
    "SELECT id FROM jobs WHERE state = 'queued' ORDER BY id LIMIT 1";
/// The oldest running job whose lease has lapsed at ?1. PostgreSQL: likewise.
inline constexpr const char* kFindOldestLapsed =
    "SELECT id FROM jobs WHERE state = 'running' AND lease_until <= ?1 ORDER BY id LIMIT 1";

/// Settings of each connection. PostgreSQL: SET synchronous_commit = on; the rest is its nature.
inline constexpr const char* kConnectionSettings =
    "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON;"
    "PRAGMA secure_delete = ON; PRAGMA temp_store = MEMORY; PRAGMA trusted_schema = OFF;"
    "PRAGMA wal_autocheckpoint = 4000; PRAGMA cache_size = -2000";
/// Empties the log file; the first column is 1 if readers prevented it. PostgreSQL: nothing to do,
/// but deleted rows stay in the files until VACUUM, and in its log until that is recycled.
inline constexpr const char* kEmptyLog = "PRAGMA wal_checkpoint(TRUNCATE)";
/// How long a statement waits for other processes [ms].
inline constexpr const char* kWaitLong = "PRAGMA busy_timeout = 10000";
inline constexpr const char* kWaitShort = "PRAGMA busy_timeout = 20";
/// One row "ok", or one row per fault. PostgreSQL: amcheck.
inline constexpr const char* kCheckIntegrity = "PRAGMA integrity_check";

}  // namespace gaitmill::dialect

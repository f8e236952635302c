#include "service/storage/schema.h"

#include <cstddef>

#include "core/base/error.h"
#include "service/storage/dialect.h"
#include "service/storage/migrations.h"

namespace gaitmill {

namespace {

constexpr const char* kCreateVersions =
    "CREATE TABLE IF NOT EXISTS schema_versions (version INTEGER PRIMARY KEY, name TEXT NOT NULL)";
constexpr const char* kFindVersion = "SELECT coalesce(max(version), 0) FROM schema_versions";
constexpr const char* kAddVersion = "INSERT INTO schema_versions (version, name) VALUES (?1, ?2)";

// The version is asked again under the write lock: another process may have been faster.
void applyNext(Connection& db, std::int64_t version) {
  db.prepare(dialect::kBeginWrite).run();
  try {
    if (findSchemaVersion(db) == version) {
      const Migration& migration = allMigrations()[static_cast<std::size_t>(version)];
      db.runScript(migration.sql);
      db.prepare(kAddVersion).bind(1, version + 1).bind(2, migration.name).run();
    }
    db.prepare(dialect::kCommit).run();
  } catch (const Error&) {
    if (db.isInTransaction()) {
      db.runScript(dialect::kRollBack);
    }
    throw;
  }
}

}  // namespace

std::int64_t findSchemaVersion(Connection& db) {
  Statement query = db.prepare(kFindVersion);
  query.step();
  return query.integer(0);
}

void requireKnownVersion(Connection& db, const std::string& path) {
  const std::int64_t version = findSchemaVersion(db);
  const auto known = static_cast<std::int64_t>(allMigrations().size());
  require(version <= known,
          ErrorCode::kStorageVersion,
          "the database has version " + std::to_string(version) + ", this gaitmill knows " +
              std::to_string(known) + "; use the newer gaitmill that wrote it",
          {path});
}

void migrateDatabase(Connection& db, const std::string& path) {
  db.runScript(kCreateVersions);
  requireKnownVersion(db, path);
  const auto known = static_cast<std::int64_t>(allMigrations().size());
  for (std::int64_t version = findSchemaVersion(db); version < known;
       version = findSchemaVersion(db)) {
    applyNext(db, version);
  }
}

}  // namespace gaitmill

#include "service/storage/idempotency_store.h"

#include "service/storage/clock.h"
#include "service/storage/sql/idempotency.h"

namespace gaitmill {

namespace {

struct StoredAnswer {
  api::KeptAnswer answer;
  std::int64_t created_at = 0;
  std::string owner;
};

std::optional<StoredAnswer> findAnswer(Connection& db,
                                       const std::string& tenant,
                                       const std::string& key) {
  Statement row = db.prepare(sql::kFindAnswer);
  if (!row.bind(1, tenant).bind(2, key).step()) {
    return std::nullopt;
  }
  return StoredAnswer{
      {row.text(0), static_cast<int>(row.integer(1)), row.text(2), row.text(3), row.text(4)},
      row.integer(5),
      row.text(6)};
}

void releaseKey(Connection& db, const std::string& tenant, const std::string& key) {
  for (const char* release : sql::kReleaseKey) {
    db.prepare(release).bind(1, tenant).bind(2, key).run();
  }
}

}  // namespace

std::optional<api::KeptAnswer> IdempotencyStore::begin(const std::string& tenant,
                                                       const std::string& key,
                                                       const std::string& request_hash) {
  return database_.write([&](Connection& db) -> std::optional<api::KeptAnswer> {
    const std::int64_t now = nowMilliseconds();
    const std::optional<StoredAnswer> known = findAnswer(db, tenant, key);
    const bool is_expired = known && known->created_at < now - kKeptMilliseconds;
    const bool is_orphan = known && known->answer.status == 0 && known->owner != owner_ &&
                           known->answer.request_hash == request_hash;
    if (known && !is_expired && !is_orphan) {
      return known->answer;
    }
    if (is_expired) {
      releaseKey(db, tenant, key);
    }
    db.prepare(sql::kBeginAnswer)
        .bind(1, tenant)
        .bind(2, key)
        .bind(3, owner_)
        .bind(4, now)
        .bind(5, request_hash)
        .run();
    return std::nullopt;
  });
}

void IdempotencyStore::finish(const std::string& tenant,
                              const std::string& key,
                              const api::KeptAnswer& answer) {
  database_.write([&](Connection& db) {
    db.prepare(sql::kFinishAnswer)
        .bind(1, tenant)
        .bind(2, key)
        .bind(3, std::int64_t{answer.status})
        .bind(4, answer.content_type)
        .bind(5, answer.location)
        .bind(6, answer.body)
        .run();
  });
}

void IdempotencyStore::abandon(const std::string& tenant, const std::string& key) {
  database_.write(
      [&](Connection& db) { db.prepare(sql::kAbandonAnswer).bind(1, tenant).bind(2, key).run(); });
}

int IdempotencyStore::removeExpired() {
  return static_cast<int>(database_.write([&](Connection& db) {
    const std::int64_t expired = nowMilliseconds() - kKeptMilliseconds;
    for (const char* release : sql::kReleaseExpiredKeys) {
      db.prepare(release).bind(1, expired).run();
    }
    db.prepare(sql::kDropExpiredAnswers).bind(1, expired).run();
    return db.changes();
  }));
}

}  // namespace gaitmill

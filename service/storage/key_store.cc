#include "service/storage/key_store.h"

#include <nlohmann/json.hpp>

#include "api/dto/object_reader.h"
#include "core/base/error.h"
#include "service/storage/clock.h"
#include "service/storage/ids.h"
#include "service/storage/sql/keys.h"
#include "service/storage/sql/usage.h"
#include "service/storage/usage_rows.h"

namespace gaitmill {

namespace {

api::KeyView readRow(const Statement& row) {
  api::KeyView key;
  key.id = row.text(0);
  key.tenant = row.text(1);
  key.name = row.text(2);
  key.scopes = nlohmann::json::parse(row.text(3)).get<std::vector<std::string>>();
  key.created_at = row.integer(4);
  key.revoked_at = row.integer(5);
  return key;
}

}  // namespace

api::KeyView KeyStore::add(const api::KeyView& key, const std::string& secret_sha256) {
  api::KeyView added = key;
  database_.write([&](Connection& db) {
    added.id = makeId("key_");
    added.created_at = findTimeOfId(added.id);
    added.revoked_at = 0;
    db.prepare(sql::kAddKey)
        .bind(1, added.id)
        .bind(2, added.tenant)
        .bind(3, added.name)
        .bind(4, api::dumpJson(added.scopes))
        .bind(5, secret_sha256)
        .bind(6, added.created_at)
        .run();
    nextCount(db, "keys");
  });
  return added;
}

std::optional<api::KeyView> KeyStore::findBySecretHash(const std::string& secret_sha256) {
  const ReadTransaction db = database_.read();
  Statement row = db->prepare(sql::kFindKeyByHash);
  return row.bind(1, secret_sha256).step() ? std::optional(readRow(row)) : std::nullopt;
}

std::vector<api::KeyView> KeyStore::list(const std::string& tenant) {
  std::vector<api::KeyView> keys;
  const ReadTransaction db = database_.read();
  Statement rows = db->prepare(sql::kListKeys);
  rows.bind(1, tenant);
  while (rows.step()) {
    keys.push_back(readRow(rows));
  }
  return keys;
}

void KeyStore::revoke(const std::string& tenant, const std::string& key_id) {
  database_.write([&](Connection& db) {
    require(db.prepare(sql::kKeyExists).bind(1, key_id).bind(2, tenant).step(),
            ErrorCode::kKeyNotFound,
            "there is no key '" + key_id + "'",
            {"", 0, 0, "key"});
    db.prepare(sql::kRevokeKey).bind(1, key_id).bind(2, tenant).bind(3, nowMilliseconds()).run();
    nextCount(db, "keys");
  });
}

bool KeyStore::hasKeys() {
  const ReadTransaction db = database_.read();
  return db->prepare(sql::kHasKeys).step();
}

std::int64_t KeyStore::version() {
  const ReadTransaction db = database_.read();
  Statement row = db->prepare(sql::kFindCount);
  row.bind(1, "keys").step();
  return row.integer(0);
}

Usage KeyStore::findUsage(const std::string& tenant, const std::string& key_id) {
  const ReadTransaction db = database_.read();
  Statement row = db->prepare(sql::kFindUsage);
  if (!row.bind(1, tenant).bind(2, key_id).step()) {
    return {};
  }
  return {row.integer(0), row.integer(1), row.integer(2), row.integer(3), row.integer(4)};
}

}  // namespace gaitmill

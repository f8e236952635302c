#include "service/storage/catalog_store.h"

#include <utility>
#include <vector>

#include "core/base/error.h"
#include "service/storage/blob_store.h"
#include "service/storage/ids.h"
#include "service/storage/list_query.h"
#include "service/storage/sql/catalog.h"
#include "service/storage/usage_rows.h"

namespace gaitmill {

namespace {

struct KindNames {
  const char* kind;
  const char* prefix;
  const char* words;
  ErrorCode not_found;
  const char* is_used;
};

KindNames namesOf(CatalogKind kind) {
  if (kind == CatalogKind::kModel) {
    return {"model", "mod_", "model", ErrorCode::kModelNotFound, sql::kModelIsUsed};
  }
  return {"marker_set", "mks_", "marker set", ErrorCode::kMarkerSetNotFound, sql::kMarkerSetIsUsed};
}

struct StoredEntry {
  api::CatalogEntry entry;
  std::int64_t blob_id = 0;
  std::string key_id;
};

StoredEntry readRow(const Statement& row) {
  StoredEntry stored;
  stored.entry.id = row.text(0);
  stored.entry.name = row.text(1);
  stored.entry.created_at = row.integer(2);
  stored.entry.summary_json = row.text(3);
  stored.entry.size = row.integer(4);
  stored.entry.sha256 = row.text(5);
  stored.blob_id = row.integer(6);
  stored.key_id = row.text(7);
  return stored;
}

StoredEntry requireEntry(Connection& db,
                         CatalogKind kind,
                         const std::string& tenant,
                         const std::string& id) {
  const KindNames names = namesOf(kind);
  Statement row = db.prepare(sql::kFindEntry);
  require(row.bind(1, id).bind(2, tenant).bind(3, names.kind).step(),
          names.not_found,
          std::string("there is no ") + names.words + " '" + id + "'",
          {"", 0, 0, names.kind});
  return readRow(row);
}

std::optional<std::string> findSubmitted(Connection& db, const NewCatalogEntry& entry) {
  Statement row = db.prepare(sql::kFindEntryBySubmission);
  row.bind(1, entry.tenant).bind(2, entry.submission_key);
  return !entry.submission_key.empty() && row.step() ? std::optional(row.text(0)) : std::nullopt;
}

void insertEntry(Connection& db,
                 const KindNames& names,
                 const NewCatalogEntry& entry,
                 const std::string& id,
                 std::int64_t blob_id) {
  db.prepare(sql::kAddEntry)
      .bind(1, id)
      .bind(2, entry.tenant)
      .bind(3, entry.key_id)
      .bind(4, names.kind)
      .bind(5, entry.name)
      .bind(6, findTimeOfId(id))
      .bind(7, entry.summary_json)
      .bind(8, blob_id)
      .bind(9, entry.submission_key)
      .run();
}

}  // namespace

api::CatalogEntry CatalogStore::add(const NewCatalogEntry& entry, const Quota& quota) {
  const KindNames names = namesOf(kind_);
  BlobStore blobs(database_);
  const auto source = api::makeByteSource(entry.document);
  while (true) {
    const IncomingBlob blob = blobs.prepare(*source);
    const auto write = [&](Connection& db) -> std::optional<std::string> {
      if (const auto earlier = findSubmitted(db, entry)) {
        return earlier;
      }
      const std::optional<std::int64_t> blob_id = blobs.attach(db, blob);
      if (!blob_id) {
        return std::nullopt;
      }
      const std::string new_id = makeId(names.prefix);
      insertEntry(db, names, entry, new_id, *blob_id);
      chargeUsage(db, entry.tenant, entry.key_id, {blob.size, 0, 0, 0, 0}, quota);
      return new_id;
    };
    if (const std::optional<std::string> id = database_.write(write)) {
      return find(entry.tenant, *id);
    }
  }
}

api::CatalogEntry CatalogStore::find(const std::string& tenant, const std::string& id) {
  return requireEntry(*database_.read(), kind_, tenant, id).entry;
}

api::Page<api::CatalogEntry> CatalogStore::list(const std::string& tenant,
                                                const api::PageRequest& page) {
  ListQuery query(sql::kSelectEntries, tenant, namesOf(kind_).prefix);
  query.where("kind =", namesOf(kind_).kind).page(page);
  std::vector<api::CatalogEntry> entries;
  const ReadTransaction db = database_.read();
  Statement rows = query.run(*db);
  while (rows.step()) {
    entries.push_back(readRow(rows).entry);
  }
  return makePage(std::move(entries), page);
}

api::FileContent CatalogStore::readDocument(const std::string& tenant, const std::string& id) {
  const StoredEntry stored = requireEntry(*database_.read(), kind_, tenant, id);
  return {{stored.entry.name, stored.entry.size, stored.entry.sha256},
          BlobStore(database_).open(stored.blob_id, stored.entry.size)};
}

void CatalogStore::remove(const std::string& tenant, const std::string& id) {
  const KindNames names = namesOf(kind_);
  BlobStore blobs(database_);
  std::vector<std::int64_t> unused;
  database_.write([&](Connection& db) {
    const StoredEntry stored = requireEntry(db, kind_, tenant, id);
    Statement use = db.prepare(names.is_used);
    use.bind(1, id);
    if (kind_ == CatalogKind::kMarkerSet) {
      use.bind(2, tenant);
    }
    require(!use.step(),
            ErrorCode::kCatalogInUse,
            std::string("the ") + names.words + " '" + id + "' is still referred to",
            {"", 0, 0, names.kind});
    db.prepare(sql::kDropEntry).bind(1, id).run();
    const auto last = blobs.release(db, stored.blob_id);
    unused.assign(last ? 1 : 0, last.value_or(0));
    chargeUsage(db, tenant, stored.key_id, {-stored.entry.size, 0, 0, 0, 0});
  });
  blobs.purge(unused);
  database_.wipeDeleted();
}

}  // namespace gaitmill

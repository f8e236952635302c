#include "service/storage/blob_store.h"

#include <algorithm>
#include <utility>

#include "core/base/error.h"
#include "service/storage/sha256.h"
#include "service/storage/sql/blobs.h"

namespace gaitmill {

namespace {

// Up to here a blob is written and deleted together with the row that refers to it.
constexpr std::int64_t kSmallSize = 2 * static_cast<std::int64_t>(BlobStore::kChunkSize);
constexpr std::int64_t kChunksPerDelete = 4;

std::string calcHash(const api::ByteSource& source) {
  Sha256 hash;
  for (std::uint64_t begin = 0; begin < source.size(); begin += BlobStore::kChunkSize) {
    hash.update(source.read(begin, BlobStore::kChunkSize));
  }
  return hash.finish();
}

void insertChunk(Connection& db, std::int64_t blob, std::int64_t begin, const PackedBytes& chunk) {
  db.prepare(sql::kAddChunk)
      .bind(1, blob)
      .bind(2, begin)
      .bind(3, chunk.size)
      .bind(4, encodingName(chunk.encoding))
      .bind(5, chunk.sha256)
      .bindBytes(6, chunk.bytes)
      .run();
}

std::int64_t insertBlob(Connection& db, const IncomingBlob& blob, std::int64_t uses) {
  Statement row = db.prepare(sql::kAddBlob);
  row.bind(1, blob.sha256).bind(2, blob.size).bind(3, uses).step();
  return row.integer(0);
}

std::optional<std::int64_t> findBlob(Connection& db, const std::string& sha256) {
  Statement row = db.prepare(sql::kFindBlob);
  return row.bind(1, sha256).step() ? std::optional(row.integer(0)) : std::nullopt;
}

class BlobSource final : public api::ByteSource {
 public:
  BlobSource(Database& database, std::int64_t blob_id, std::int64_t size)
      : database_(database), blob_id_(blob_id), size_(static_cast<std::uint64_t>(size)) {}

  std::uint64_t size() const override { return size_; }
  std::string read(std::uint64_t offset, std::size_t size) const override;

 private:
  void load(std::uint64_t offset) const;

  Database& database_;
  std::int64_t blob_id_;
  std::uint64_t size_;
  mutable std::uint64_t begins_ = 0;  ///< of the chunk read last
  mutable std::string chunk_;
};

std::string BlobSource::read(std::uint64_t offset, std::size_t size) const {
  std::string bytes;
  const std::uint64_t end = std::min<std::uint64_t>(size_, offset + size);
  while (offset < end) {
    if (offset < begins_ || offset >= begins_ + chunk_.size()) {
      load(offset);
    }
    const std::string piece = chunk_.substr(offset - begins_, end - offset);
    bytes += piece;
    offset += piece.size();
  }
  return bytes;
}

void BlobSource::load(std::uint64_t offset) const {
  PackedBytes packed;
  {
    const ReadTransaction db = database_.read();
    Statement row = db->prepare(sql::kReadChunk);
    require(row.bind(1, blob_id_).bind(2, static_cast<std::int64_t>(offset)).step(),
            ErrorCode::kStorage,
            "stored bytes are gone: the file has been deleted while it was read",
            {"", 0, 0, "file"});
    begins_ = static_cast<std::uint64_t>(row.integer(0));
    packed.size = row.integer(1);
    packed.encoding = findEncoding(row.text(2));
    packed.sha256 = row.text(3);
    packed.bytes = row.bytes(4);
  }
  chunk_ = unpack(packed, "a piece of a stored file");
  require(offset < begins_ + chunk_.size(),
          ErrorCode::kStorage,
          "a piece of a stored file is missing",
          {"", 0, 0, "file"});
}

}  // namespace

IncomingBlob BlobStore::prepare(const api::ByteSource& source) {
  IncomingBlob blob;
  blob.sha256 = calcHash(source);
  blob.size = static_cast<std::int64_t>(source.size());
  if (findBlob(*database_.read(), blob.sha256)) {
    return blob;
  }
  database_.requireRoom(source.size());
  if (blob.size > kSmallSize) {
    blob.staged_id = stage(source, blob);
    return blob;
  }
  for (std::uint64_t begin = 0; begin < source.size(); begin += kChunkSize) {
    blob.chunks.push_back(pack(source.read(begin, kChunkSize)));
  }
  return blob;
}

std::int64_t BlobStore::stage(const api::ByteSource& source, const IncomingBlob& blob) {
  IncomingBlob staged = blob;
  const std::int64_t id =
      database_.write([&blob](Connection& db) { return insertBlob(db, blob, 0); });
  staged.staged_id = id;
  try {
    for (std::uint64_t begin = 0; begin < source.size(); begin += kChunkSize) {
      const PackedBytes chunk = pack(source.read(begin, kChunkSize));
      database_.writeBulk([id, begin, &chunk](Connection& db) {
        insertChunk(db, id, static_cast<std::int64_t>(begin), chunk);
      });
    }
  } catch (...) {
    discard({staged});
    throw;
  }
  return id;
}

std::optional<std::int64_t> BlobStore::attach(Connection& db, const IncomingBlob& blob) {
  std::optional<std::int64_t> id = findBlob(db, blob.sha256);
  if (!id) {
    id = blob.staged_id;
  }
  if (id) {
    db.prepare(sql::kUseBlob).bind(1, *id).run();
    return db.changes() == 1 ? id : std::nullopt;
  }
  if (blob.chunks.empty() && blob.size > 0) {
    return std::nullopt;
  }
  id = insertBlob(db, blob, 1);
  std::int64_t begin = 0;
  for (const PackedBytes& chunk : blob.chunks) {
    insertChunk(db, *id, begin, chunk);
    begin += chunk.size;
  }
  return id;
}

std::optional<std::int64_t> BlobStore::release(Connection& db, std::int64_t blob_id) {
  std::int64_t size = 0;
  {
    Statement row = db.prepare(sql::kReleaseBlob);
    row.bind(1, blob_id).step();
    if (row.integer(0) > 0) {
      return std::nullopt;
    }
    size = row.integer(1);
  }
  if (size > kSmallSize) {
    return blob_id;
  }
  db.prepare(sql::kDropBlob).bind(1, blob_id).run();
  return std::nullopt;
}

void BlobStore::purge(const std::vector<std::int64_t>& blob_ids) {
  for (const std::int64_t id : blob_ids) {
    const auto drop_some = [id](Connection& db) {
      db.prepare(sql::kDropChunks).bind(1, id).bind(2, kChunksPerDelete).run();
      return db.changes();
    };
    while (database_.writeBulk(drop_some) > 0) {
    }
    database_.write([id](Connection& db) { db.prepare(sql::kDropBlob).bind(1, id).run(); });
  }
}

void BlobStore::discard(const std::vector<IncomingBlob>& blobs) noexcept {
  try {
    const std::vector<std::int64_t> unused = listUnused();
    for (const IncomingBlob& blob : blobs) {
      if (blob.staged_id && std::count(unused.begin(), unused.end(), *blob.staged_id) > 0) {
        purge({*blob.staged_id});
      }
    }
  } catch (const std::exception&) {
    // The next start finds it: see removeUnfinishedUploads().
  }
}

std::vector<std::int64_t> BlobStore::listUnused() {
  std::vector<std::int64_t> ids;
  const ReadTransaction db = database_.read();
  Statement rows = db->prepare(sql::kListUnusedBlobs);
  while (rows.step()) {
    ids.push_back(rows.integer(0));
  }
  return ids;
}

std::shared_ptr<const api::ByteSource> BlobStore::open(std::int64_t blob_id, std::int64_t size) {
  return std::make_shared<BlobSource>(database_, blob_id, size);
}

}  // namespace gaitmill

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "api/http.h"
#include "service/storage/compression.h"
#include "service/storage/database.h"

namespace gaitmill {

/// Bytes on their way into the database.
struct IncomingBlob {
  std::string sha256;
  std::int64_t size = 0;
  std::vector<PackedBytes> chunks;        ///< of a small one, for attach() to insert
  std::optional<std::int64_t> staged_id;  ///< of a large one, whose chunks are stored already
};

/// Bytes by their content, for the stores that own references to them. Each piece is compressed
/// and hashed on its own.
class BlobStore {
 public:
  static constexpr std::size_t kChunkSize = std::size_t{1} << 20;

  explicit BlobStore(Database& database) : database_(database) {}

  /// Reads and hashes the source. Unless the content is stored already, a small one is packed for
  /// attach(), and a large one stored chunk by chunk, without a reference yet.
  /// @throws Error kStorageFull
  IncomingBlob prepare(const api::ByteSource& source);
  /// Within the caller's write: one more reference to this content. @returns the blob's id;
  /// nullopt if the content was stored when prepare() looked and has been deleted since: prepare
  /// it again
  std::optional<std::int64_t> attach(Connection& db, const IncomingBlob& blob);
  /// Within the caller's write: one reference less. @returns the id if that was the last one and
  /// its bytes are left to purge()
  std::optional<std::int64_t> release(Connection& db, std::int64_t blob_id);

  /// Deletes the chunks of blobs without references, in small transactions.
  void purge(const std::vector<std::int64_t>& blob_ids);
  /// Deletes what prepare() stored, if nothing came to refer to it. Does not throw: what it leaves
  /// behind is found by listUnused() at the next start.
  void discard(const std::vector<IncomingBlob>& blobs) noexcept;
  std::vector<std::int64_t> listUnused();

  /// The bytes, read piece by piece and verified. Needs the database as long as it lives.
  std::shared_ptr<const api::ByteSource> open(std::int64_t blob_id, std::int64_t size);

 private:
  std::int64_t stage(const api::ByteSource& source, const IncomingBlob& blob);

  Database& database_;
};

}  // namespace gaitmill

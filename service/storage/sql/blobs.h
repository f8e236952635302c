#pragma once

namespace gaitmill::sql {

inline constexpr const char* kFindBlob = "SELECT id FROM blobs WHERE sha256 = ?1 AND uses > 0";
inline constexpr const char* kAddBlob =
    "INSERT INTO blobs (sha256, size, uses) VALUES (?1, ?2, ?3) RETURNING id";
inline constexpr const char* kUseBlob = "UPDATE blobs SET uses = uses + 1 WHERE id = ?1";
inline constexpr const char* kReleaseBlob =
    "UPDATE blobs SET uses = uses - 1 WHERE id = ?1 RETURNING uses, size";
inline constexpr const char* kDropBlob = "DELETE FROM blobs WHERE id = ?1 AND uses = 0";
inline constexpr const char* kListUnusedBlobs = "SELECT id FROM blobs WHERE uses = 0 ORDER BY id";
inline constexpr const char* kAddChunk =
    "INSERT INTO blob_chunks (blob_id, begins, size, encoding, sha256, bytes) "
    "VALUES (?1, ?2, ?3, ?4, ?5, ?6)";
inline constexpr const char* kReadChunk =
    "SELECT begins, size, encoding, sha256, bytes FROM blob_chunks "
    "WHERE blob_id = ?1 AND begins <= ?2 ORDER BY begins DESC LIMIT 1";
/// Some pieces of a blob that nobody uses: a blob used again keeps them.
inline constexpr const char* kDropChunks =
    "DELETE FROM blob_chunks WHERE blob_id = ?1 AND begins IN "
    "(SELECT begins FROM blob_chunks WHERE blob_id = ?1 ORDER BY begins LIMIT ?2)";

}  // namespace gaitmill::sql

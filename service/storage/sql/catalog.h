#pragma once

namespace gaitmill::sql {

inline constexpr const char* kAddEntry =
    "INSERT INTO catalog (id, tenant, key_id, kind, name, created_at, summary, blob_id, "
    "submission_key) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)";
inline constexpr const char* kFindEntryBySubmission =
    "SELECT id FROM catalog WHERE tenant = ?1 AND submission_key = ?2 AND submission_key <> ''";
inline constexpr const char* kSelectEntries =
    "SELECT id, name, created_at, summary, "
    "(SELECT size FROM blobs WHERE blobs.id = catalog.blob_id), "
    "(SELECT sha256 FROM blobs WHERE blobs.id = catalog.blob_id), blob_id, key_id FROM catalog";
inline constexpr const char* kFindEntry =
    "SELECT id, name, created_at, summary, "
    "(SELECT size FROM blobs WHERE blobs.id = catalog.blob_id), "
    "(SELECT sha256 FROM blobs WHERE blobs.id = catalog.blob_id), blob_id, key_id FROM catalog "
    "WHERE id = ?1 AND tenant = ?2 AND kind = ?3";
inline constexpr const char* kModelIsUsed =
    "SELECT 1 FROM jobs WHERE model_id = ?1 AND model_id <> '' LIMIT 1";
inline constexpr const char* kMarkerSetIsUsed =
    "SELECT 1 FROM trials WHERE marker_set = ?1 AND tenant = ?2 LIMIT 1";
inline constexpr const char* kDropEntry = "DELETE FROM catalog WHERE id = ?1";

}  // namespace gaitmill::sql

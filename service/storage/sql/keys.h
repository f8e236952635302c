#pragma once

namespace gaitmill::sql {

inline constexpr const char* kAddKey =
    "INSERT INTO api_keys (id, tenant, name, scopes, secret_sha256, created_at) "
    "VALUES (?1, ?2, ?3, ?4, ?5, ?6)";
inline constexpr const char* kFindKeyByHash =
    "SELECT id, tenant, name, scopes, created_at, revoked_at FROM api_keys "
    "WHERE secret_sha256 = ?1 AND revoked_at = 0";
inline constexpr const char* kListKeys =
    "SELECT id, tenant, name, scopes, created_at, revoked_at FROM api_keys "
    "WHERE tenant = ?1 OR ?1 = '' ORDER BY id DESC";
inline constexpr const char* kRevokeKey =
    "UPDATE api_keys SET revoked_at = ?3 WHERE id = ?1 AND (tenant = ?2 OR ?2 = '') "
    "AND revoked_at = 0";
inline constexpr const char* kKeyExists =
    "SELECT 1 FROM api_keys WHERE id = ?1 AND (tenant = ?2 OR ?2 = '')";
inline constexpr const char* kHasKeys = "SELECT 1 FROM api_keys WHERE revoked_at = 0 LIMIT 1";

}  // namespace gaitmill::sql

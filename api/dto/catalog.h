#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gaitmill::api {

/// A model document, or a marker set: shipped with gaitmill ("rajagopal2016", same for everyone) or
/// uploaded ("mod_…", "mks_…", the tenant's own).
struct CatalogEntry {
  std::string id;
  std::string name;
  bool shipped = false;
  std::int64_t created_at = 0;  ///< [ms since 1970 UTC], 0 if shipped
  std::int64_t size = 0;        ///< [bytes] of the document
  std::string sha256;           ///< hex
  /// Models: JSON of what was understood (bodies, coordinates, muscles, actuators, warnings).
  /// Marker sets: JSON with the names of the markers.
  std::string summary_json;
};

/// An API key as its owner sees it. The secret is shown once, when it is made.
struct KeyView {
  std::string id;  ///< "key_…"
  std::string tenant;
  std::string name;
  std::vector<std::string> scopes;  ///< "read", "write", "admin"
  std::int64_t created_at = 0;      ///< [ms since 1970 UTC]
  std::int64_t revoked_at = 0;      ///< 0 = in force
  std::string secret;               ///< only in the answer to its creation
};

/// {"name": "lab computer", "scopes": ["read", "write"]}
struct KeyRequest {
  std::string name;
  std::vector<std::string> scopes;  ///< at least one
};

std::string renderCatalogEntry(const CatalogEntry& entry);
/// @throws Error kRequestMalformed, kRequestField naming the field
KeyRequest parseKeyRequest(const std::string& json);
std::string renderKey(const KeyView& key);

}  // namespace gaitmill::api

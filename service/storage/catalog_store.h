#pragma once

#include <memory>
#include <string>

#include "api/dto/catalog.h"
#include "api/dto/page.h"
#include "api/dto/result.h"
#include "service/storage/database.h"
#include "service/storage/usage.h"

namespace gaitmill {

enum class CatalogKind { kModel, kMarkerSet };

struct NewCatalogEntry {
  std::string tenant;
  std::string key_id;
  std::string name;
  std::string document;
  std::string summary_json;
  std::string submission_key;  ///< as in NewJob
};

/// Uploaded models ("mod_…") or marker sets ("mks_…"), one store for each; shipped ones are files.
/// Another tenant's entry does not exist: kModelNotFound or kMarkerSetNotFound.
class CatalogStore {
 public:
  CatalogStore(Database& database, CatalogKind kind) : database_(database), kind_(kind) {}

  /// @throws Error kQuotaExceeded, kStorageFull
  api::CatalogEntry add(const NewCatalogEntry& entry, const Quota& quota = {});
  api::CatalogEntry find(const std::string& tenant, const std::string& id);
  /// Newest first. @throws Error kRequestField for a bad cursor
  api::Page<api::CatalogEntry> list(const std::string& tenant, const api::PageRequest& page);
  /// Verified.
  api::FileContent readDocument(const std::string& tenant, const std::string& id);
  /// @throws Error kCatalogInUse if a trial or job refers to it
  void remove(const std::string& tenant, const std::string& id);

 private:
  Database& database_;
  CatalogKind kind_;
};

}  // namespace gaitmill

#pragma once

#include <string>
#include <vector>

#include "api/ports.h"
#include "service/pipeline_functions.h"
#include "service/shipped_catalog.h"
#include "service/storage/catalog_store.h"

namespace gaitmill {

/// Models, or marker sets, behind the API: the shipped ones, same for everyone and last in lists,
/// and the tenant's own.
class CatalogService : public api::CatalogPort {
 public:
  /// @param shipped  outlives the service
  /// @param quota    of each API key
  CatalogService(CatalogStore& store,
                 const std::vector<ShippedDocument>& shipped,
                 DocumentReader read,
                 const Quota& quota);

  api::CatalogEntry add(const api::Identity& who,
                        const std::string& name,
                        std::string document) override;
  api::Page<api::CatalogEntry> list(const api::Identity& who,
                                    const api::PageRequest& page) override;
  api::CatalogEntry find(const api::Identity& who, const std::string& id) override;
  api::FileContent findDocument(const api::Identity& who, const std::string& id) override;
  void remove(const api::Identity& who, const std::string& id) override;

 private:
  const ShippedDocument* findShipped(const std::string& id) const;

  CatalogStore& store_;
  const std::vector<ShippedDocument>& shipped_;
  DocumentReader read_;
  Quota quota_;
};

}  // namespace gaitmill

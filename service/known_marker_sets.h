#pragma once

#include <string>
#include <vector>

#include "api/dto/trial.h"
#include "core/data/marker_set.h"
#include "service/shipped_catalog.h"
#include "service/storage/catalog_store.h"

namespace gaitmill {

/// The marker sets that a tenant may name: the shipped ones and its own.
class KnownMarkerSets {
 public:
  /// @throws Error kInternal if what ships has no markers
  KnownMarkerSets(const ShippedCatalog& shipped, CatalogStore& uploaded);

  /// Their ids as names, and the markers that inverse kinematics asks for.
  std::vector<MarkerSetSpec> list(const std::string& tenant) const;

  /// @throws Error kMarkerSetNotFound unless the tenant may name it
  void require(const std::string& tenant, const std::string& id) const;

  /// Fills in what each marker file of the trial has and lacks of each of the sets.
  static void match(const std::vector<MarkerSetSpec>& sets, api::TrialView& trial);

 private:
  std::vector<MarkerSetSpec> shipped_;
  CatalogStore& uploaded_;
};

}  // namespace gaitmill

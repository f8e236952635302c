#pragma once

#include <string>
#include <vector>

#include "api/dto/catalog.h"
#include "core/pipeline/pipeline.h"
#include "service/pipeline_functions.h"

namespace gaitmill {

/// A document that ships with gaitmill, and what was understood of it.
struct ShippedDocument {
  api::CatalogEntry entry;
  InputFile file;
};

/// The models (<models>/<name>/<name>.osim) and marker sets (<models>/marker_sets/<name>.json) that
/// ship with gaitmill, read once. Immutable, safe to share between threads.
class ShippedCatalog {
 public:
  /// The model of trials that bring none and jobs that name none.
  static constexpr const char* kDefaultModel = "rajagopal2016";

  /// @throws Error of a reader: what ships must be readable
  ShippedCatalog(const std::string& models_folder, const PipelineFunctions& functions);

  const std::vector<ShippedDocument>& models() const { return models_; }
  const std::vector<ShippedDocument>& markerSets() const { return marker_sets_; }
  /// nullptr if none has this name.
  const ShippedDocument* findModel(const std::string& name) const;
  const ShippedDocument* findMarkerSet(const std::string& name) const;

 private:
  std::vector<ShippedDocument> models_;       ///< in alphabetical order
  std::vector<ShippedDocument> marker_sets_;  ///<
};

}  // namespace gaitmill

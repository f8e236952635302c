#include "service/known_marker_sets.h"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/pipeline/settings.h"
#include "core/pipeline/understanding.h"
#include "service/job_input.h"

namespace gaitmill {

namespace {

constexpr int kPageSize = 200;

MarkerSetSpec readSet(const api::CatalogEntry& entry) {
  const auto summary = nlohmann::json::parse(entry.summary_json, nullptr, false);
  check(summary.is_object() && summary.contains("markers") && summary["markers"].is_array(),
        "the summary of a marker set has no markers");
  MarkerSetSpec set;
  set.name = entry.id;
  for (const auto& marker : summary["markers"]) {
    set.ik.markers.push_back({marker.get<std::string>(), 1.0});
  }
  return set;
}

}  // namespace

KnownMarkerSets::KnownMarkerSets(const ShippedCatalog& shipped, CatalogStore& uploaded)
    : uploaded_(uploaded) {
  for (const ShippedDocument& document : shipped.markerSets()) {
    shipped_.push_back(readSet(document.entry));
  }
}

std::vector<MarkerSetSpec> KnownMarkerSets::list(const std::string& tenant) const {
  std::vector<MarkerSetSpec> sets = shipped_;
  api::PageRequest page;
  page.limit = kPageSize;
  do {
    const api::Page<api::CatalogEntry> own = uploaded_.list(tenant, page);
    for (const api::CatalogEntry& entry : own.items) {
      sets.push_back(readSet(entry));
    }
    page.cursor = own.next_cursor;
  } while (!page.cursor.empty());
  return sets;
}

void KnownMarkerSets::require(const std::string& tenant, const std::string& id) const {
  if (isUploadedId(id)) {
    uploaded_.find(tenant, id);
    return;
  }
  // The one that follows from the names of the markers.
  if (id == kAutomaticMarkerSet) {
    return;
  }
  const bool ships = std::any_of(
      shipped_.begin(), shipped_.end(), [&id](const MarkerSetSpec& set) { return set.name == id; });
  gaitmill::require(ships,
                    ErrorCode::kMarkerSetNotFound,
                    "there is no marker set '" + id + "'",
                    {"", 0, 0, "marker_set"});
}

void KnownMarkerSets::match(const std::vector<MarkerSetSpec>& sets, api::TrialView& trial) {
  for (api::UnderstoodFile& file : trial.files) {
    if (file.labels_kind == "markers") {
      file.marker_sets.clear();
      for (MarkerMatch& match : matchMarkers(file.labels, sets)) {
        file.marker_sets.push_back(
            {std::move(match.marker_set), std::move(match.found), std::move(match.missing)});
      }
    }
  }
}

}  // namespace gaitmill

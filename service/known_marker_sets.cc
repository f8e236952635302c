#include "service/known_marker_sets.h"

#include <algorithm>
#include <unordered_set>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "service/job_input.h"

namespace gaitmill {

namespace {

constexpr int kPageSize = 200;

std::vector<std::string> readMarkers(const api::CatalogEntry& entry) {
  const auto summary = nlohmann::json::parse(entry.summary_json, nullptr, false);
  check(summary.is_object() && summary.contains("markers") && summary["markers"].is_array(),
        "the summary of a marker set has no markers");
  return summary["markers"].get<std::vector<std::string>>();
}

api::MarkerSetMatch matchSet(const KnownMarkerSets::MarkerSet& set,
                             const std::unordered_set<std::string>& measured) {
  api::MarkerSetMatch match{set.id, {}, {}};
  for (const std::string& marker : set.markers) {
    (measured.count(marker) == 1 ? match.found : match.missing).push_back(marker);
  }
  return match;
}

// The set that misses least comes first; of equal ones, the one that says more.
bool isBetter(const api::MarkerSetMatch& a, const api::MarkerSetMatch& b) {
  const auto missing_share = [](const api::MarkerSetMatch& match) {
    return static_cast<double>(match.missing.size()) /
           static_cast<double>(std::max<std::size_t>(match.found.size() + match.missing.size(), 1));
  };
  const double a_share = missing_share(a);
  const double b_share = missing_share(b);
  return a_share != b_share ? a_share < b_share : a.found.size() > b.found.size();
}

}  // namespace

KnownMarkerSets::KnownMarkerSets(const ShippedCatalog& shipped, CatalogStore& uploaded)
    : uploaded_(uploaded) {
  for (const ShippedDocument& document : shipped.markerSets()) {
    shipped_.push_back({document.entry.id, readMarkers(document.entry)});
  }
}

std::vector<KnownMarkerSets::MarkerSet> KnownMarkerSets::list(const std::string& tenant) const {
  std::vector<MarkerSet> sets = shipped_;
  api::PageRequest page;
  page.limit = kPageSize;
  do {
    const api::Page<api::CatalogEntry> own = uploaded_.list(tenant, page);
    for (const api::CatalogEntry& entry : own.items) {
      sets.push_back({entry.id, readMarkers(entry)});
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
  const bool ships = std::any_of(
      shipped_.begin(), shipped_.end(), [&id](const MarkerSet& set) { return set.id == id; });
  gaitmill::require(ships,
                    ErrorCode::kMarkerSetNotFound,
                    "there is no marker set '" + id + "'",
                    {"", 0, 0, "marker_set"});
}

void KnownMarkerSets::match(const std::vector<MarkerSet>& sets, api::TrialView& trial) {
  for (api::UnderstoodFile& file : trial.files) {
    if (file.labels_kind != "markers") {
      continue;
    }
    const std::unordered_set<std::string> measured(file.labels.begin(), file.labels.end());
    file.marker_sets.clear();
    for (const MarkerSet& set : sets) {
      file.marker_sets.push_back(matchSet(set, measured));
    }
    std::stable_sort(file.marker_sets.begin(), file.marker_sets.end(), isBetter);
  }
}

}  // namespace gaitmill

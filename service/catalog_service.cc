#include "service/catalog_service.h"

#include <algorithm>
#include <utility>

#include "core/base/error.h"

namespace gaitmill {

CatalogService::CatalogService(CatalogStore& store,
                               const std::vector<ShippedDocument>& shipped,
                               DocumentReader read,
                               const Quota& quota)
    : store_(store), shipped_(shipped), read_(std::move(read)), quota_(quota) {}

api::CatalogEntry CatalogService::add(const api::Identity& who,
                                      const std::string& name,
                                      std::string document) {
  NewCatalogEntry entry;
  entry.tenant = who.tenant;
  entry.key_id = who.key_id;
  entry.name = name;
  InputFile file{name, std::move(document)};
  entry.summary_json = read_(file);
  entry.document = std::move(file.bytes);
  return store_.add(entry, quota_);
}

// A page may end among the tenant's own or among the shipped ones; the cursor tells which.
api::Page<api::CatalogEntry> CatalogService::list(const api::Identity& who,
                                                  const api::PageRequest& page) {
  api::Page<api::CatalogEntry> entries;
  auto next = shipped_.begin();
  if (const ShippedDocument* last = findShipped(page.cursor)) {
    next += last - shipped_.data() + 1;
  } else {
    entries = store_.list(who.tenant, page);
    if (!entries.next_cursor.empty()) {
      return entries;
    }
  }
  for (; next != shipped_.end() && entries.items.size() < static_cast<std::size_t>(page.limit);
       ++next) {
    entries.items.push_back(next->entry);
  }
  entries.next_cursor = next == shipped_.end() ? "" : entries.items.back().id;
  return entries;
}

api::CatalogEntry CatalogService::find(const api::Identity& who, const std::string& id) {
  const ShippedDocument* shipped = findShipped(id);
  return shipped != nullptr ? shipped->entry : store_.find(who.tenant, id);
}

api::FileContent CatalogService::findDocument(const api::Identity& who, const std::string& id) {
  const ShippedDocument* shipped = findShipped(id);
  if (shipped == nullptr) {
    return store_.readDocument(who.tenant, id);
  }
  return {{shipped->file.name, shipped->entry.size, shipped->entry.sha256},
          api::makeByteSource(shipped->file.bytes)};
}

void CatalogService::remove(const api::Identity& who, const std::string& id) {
  require(findShipped(id) == nullptr,
          ErrorCode::kCatalogInUse,
          "'" + id + "' ships with gaitmill and cannot be removed",
          {"", 0, 0, id});
  store_.remove(who.tenant, id);
}

const ShippedDocument* CatalogService::findShipped(const std::string& id) const {
  const auto found = std::find_if(shipped_.begin(), shipped_.end(), [&id](const auto& document) {
    return document.entry.id == id;
  });
  return found == shipped_.end() ? nullptr : &*found;
}

}  // namespace gaitmill

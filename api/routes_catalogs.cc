// Models and marker sets: those that ship and the tenant's own.

#include <cstdint>

#include "api/digest.h"
#include "api/dto/catalog.h"
#include "api/idempotency.h"
#include "api/route_tools.h"
#include "api/routes.h"

namespace gaitmill::api {

namespace {

constexpr std::uint64_t kMaxDocument = 16U << 20U;  // [bytes]; the shipped model has 0.3 MB

HttpReply addEntry(CatalogPort& catalog, HttpRequest& request) {
  checkContentDigest(request);
  const std::string name = findSentName(request);
  require(!name.empty(),
          ErrorCode::kRequestField,
          "the parameter 'name' says what the document is called",
          {"", 0, 0, "name"});
  const CatalogEntry entry =
      catalog.add(request.identity, name, readAll(*request.body, kMaxDocument));
  return replyCreated(201, request.path + "/" + entry.id, renderCatalogEntry(entry));
}

HttpReply listEntries(CatalogPort& catalog, HttpRequest& request) {
  return replyPage(catalog.list(request.identity, readPage(request, "")), renderCatalogEntry);
}

HttpReply findEntry(CatalogPort& catalog, HttpRequest& request) {
  return replyTagged(renderCatalogEntry(catalog.find(request.identity, request.captures.at("id"))));
}

HttpReply findDocument(CatalogPort& catalog, HttpRequest& request) {
  return replyFile(catalog.findDocument(request.identity, request.captures.at("id")),
                   "application/octet-stream");
}

HttpReply removeEntry(CatalogPort& catalog, HttpRequest& request) {
  catalog.remove(request.identity, request.captures.at("id"));
  return replyNothing();
}

Routes makeRoutesOf(CatalogPort& catalog, IdempotencyPort& idempotency, const std::string& path) {
  const Handler add = withIdempotency(idempotency, on(catalog, addEntry, {"name"}));
  const Handler list = on(catalog, listEntries, {"limit", "cursor"});
  const std::string entry = path + "/{id}";
  return {
      {"POST", path, BodyKind::kBytes, add, Scope::kWrite, kMaxDocument},
      {"GET", path, BodyKind::kNone, list, Scope::kRead},
      {"GET", entry, BodyKind::kNone, on(catalog, findEntry), Scope::kRead},
      {"DELETE", entry, BodyKind::kNone, on(catalog, removeEntry), Scope::kWrite},
      {"GET", entry + "/document", BodyKind::kNone, on(catalog, findDocument), Scope::kRead},
  };
}

}  // namespace

Routes makeCatalogRoutes(const Ports& ports) {
  Routes routes = makeRoutesOf(ports.models, ports.idempotency, "/v1/models");
  const Routes marker_sets = makeRoutesOf(ports.marker_sets, ports.idempotency, "/v1/marker_sets");
  routes.insert(routes.end(), marker_sets.begin(), marker_sets.end());
  return routes;
}

}  // namespace gaitmill::api

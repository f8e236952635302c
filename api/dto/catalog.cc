#include "api/dto/catalog.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "api/dto/object_reader.h"
#include "api/dto/timestamp.h"
#include "core/base/error.h"

namespace gaitmill::api {

namespace {

using nlohmann::json;

json timestampOrNull(std::int64_t time) {
  return time == 0 ? json(nullptr) : json(formatTimestamp(time));
}

std::string toScope(const json& value) {
  static const std::vector<std::string> known = {"read", "write", "admin"};
  const bool is_known =
      value.is_string() && std::find(known.begin(), known.end(), value) != known.end();
  require(is_known,
          ErrorCode::kRequestField,
          "field 'scopes' must be a list of read, write and admin",
          {"", 0, 0, "key.scopes"});
  return value.get<std::string>();
}

}  // namespace

std::string renderCatalogEntry(const CatalogEntry& entry) {
  const json summary =
      entry.summary_json.empty() ? json::object() : json::parse(entry.summary_json);
  return dumpJson({{"id", entry.id},
                   {"name", entry.name},
                   {"shipped", entry.shipped},
                   {"created_at", timestampOrNull(entry.created_at)},
                   {"size_bytes", entry.size},
                   {"sha256", entry.sha256},
                   {"summary", summary}});
}

KeyRequest parseKeyRequest(const std::string& text) {
  const json object = parseJson(text, "key");
  ObjectReader reader(object, "key");
  KeyRequest request;
  request.name = reader.text("name");
  const json* scopes = reader.value("scopes");
  require(scopes != nullptr && scopes->is_array() && !scopes->empty(),
          ErrorCode::kRequestField,
          "field 'scopes' must be a list of read, write and admin",
          {"", 0, 0, "key.scopes"});
  for (const json& scope : *scopes) {
    request.scopes.push_back(toScope(scope));
  }
  reader.finish();
  return request;
}

std::string renderKey(const KeyView& key) {
  json object{{"id", key.id},
              {"tenant", key.tenant},
              {"name", key.name},
              {"scopes", key.scopes},
              {"created_at", timestampOrNull(key.created_at)},
              {"revoked_at", timestampOrNull(key.revoked_at)}};
  if (!key.secret.empty()) {
    object["secret"] = key.secret;
  }
  return dumpJson(object);
}

}  // namespace gaitmill::api

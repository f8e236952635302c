// Settings that ship with gaitmill.

#include <nlohmann/json.hpp>

#include "api/dto/object_reader.h"
#include "api/route_tools.h"
#include "api/routes.h"

namespace gaitmill::api {

namespace {

HttpReply listSettings(SettingsPort& settings, HttpRequest&) {
  std::vector<std::string> items;
  for (const std::string& name : settings.listNames()) {
    items.push_back(dumpJson({{"name", name}}));
  }
  return replyTagged(renderPage(items, ""));
}

HttpReply findSettings(SettingsPort& settings, HttpRequest& request) {
  return replyTagged(settings.find(request.captures.at("name")));
}

}  // namespace

Routes makeSettingsRoutes(const Ports& ports) {
  SettingsPort& settings = ports.settings;
  return {
      {"GET", "/v1/settings", BodyKind::kNone, on(settings, listSettings), Scope::kRead},
      {"GET", "/v1/settings/{name}", BodyKind::kNone, on(settings, findSettings), Scope::kRead},
  };
}

}  // namespace gaitmill::api

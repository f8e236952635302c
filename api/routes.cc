#include "api/routes.h"

namespace gaitmill::api {

Routes makeRoutes(const Ports& ports, const std::string& version) {
  Routes all = makeServiceRoutes(ports, version);
  for (const Routes& group : {makeTrialRoutes(ports),
                              makeJobRoutes(ports),
                              makeResultRoutes(ports),
                              makeFigureRoutes(ports),
                              makeImageRoutes(ports),
                              makeStudyRoutes(ports),
                              makeCatalogRoutes(ports),
                              makeSettingsRoutes(ports),
                              makeKeyRoutes(ports)}) {
    all.insert(all.end(), group.begin(), group.end());
  }
  return all;
}

}  // namespace gaitmill::api

#pragma once

#include <string>
#include <vector>

#include "api/ports.h"
#include "api/router.h"

namespace gaitmill::api {

using Routes = std::vector<Route>;

/// All routes of the service: each reads its request, asks a port and renders the answer.
/// openapi.yaml describes them; a test holds the two lists against each other.
/// @param version  what /v1/version says
Routes makeRoutes(const Ports& ports, const std::string& version);

// The same by resource, each in the file of its name.
Routes makeServiceRoutes(const Ports& ports, const std::string& version);
Routes makeTrialRoutes(const Ports& ports);
Routes makeJobRoutes(const Ports& ports);
Routes makeResultRoutes(const Ports& ports);
Routes makeFigureRoutes(const Ports& ports);
Routes makeImageRoutes(const Ports& ports);
Routes makeStudyRoutes(const Ports& ports);
Routes makeCatalogRoutes(const Ports& ports);
Routes makeSettingsRoutes(const Ports& ports);
Routes makeKeyRoutes(const Ports& ports);

}  // namespace gaitmill::api

#pragma once

#include <string>
#include <vector>

#include "api/ports.h"
#include "api/router.h"

namespace gaitmill::api {

/// All routes of the service: each reads its request, asks one port and renders the answer.
/// openapi.yaml describes them; a test holds the two lists against each other.
/// @param version  what /v1/version says
std::vector<Route> makeRoutes(Ports ports, const std::string& version);

}  // namespace gaitmill::api

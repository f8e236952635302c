#pragma once

#include <string>

namespace gaitmill::api {

/// openapi.yaml as JSON, made from it when gaitmill is built.
const std::string& openApiDocument();

}  // namespace gaitmill::api

#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace gaitmill {

/// Faults of `value` against a schema of JSON Schema 2020-12, each with its place, in the extent
/// that openapi.yaml uses; a keyword that is not known here is a fault too, so that no part of a
/// schema is taken for checked.
/// @param root  the document that "$ref" points into
std::vector<std::string> findSchemaFaults(const nlohmann::json& value,
                                          const nlohmann::json& schema,
                                          const nlohmann::json& root);

}  // namespace gaitmill

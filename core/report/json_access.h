#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace gaitmill {

using Json = nlohmann::ordered_json;

// The summary of a job as a report reads it. A job that stopped early has less of it, so that
// nothing need be there.

/// The member at the end of a path of names; null if there is none.
const Json& findMember(const Json& object, const std::vector<std::string>& path);
/// The same as a number, NaN if it is none; as words, empty if it is none.
double findNumber(const Json& object, const std::vector<std::string>& path);
std::string findWords(const Json& object, const std::vector<std::string>& path);

}  // namespace gaitmill

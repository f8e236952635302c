#include "core/report/json_access.h"

#include <limits>

namespace gaitmill {

const Json& findMember(const Json& object, const std::vector<std::string>& path) {
  static const Json nothing;
  const Json* at = &object;
  for (const std::string& name : path) {
    const auto found = at->is_object() ? at->find(name) : at->end();
    if (found == at->end()) {
      return nothing;
    }
    at = &*found;
  }
  return *at;
}

double findNumber(const Json& object, const std::vector<std::string>& path) {
  const Json& member = findMember(object, path);
  return member.is_number() ? member.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::string findWords(const Json& object, const std::vector<std::string>& path) {
  const Json& member = findMember(object, path);
  return member.is_string() ? member.get<std::string>() : "";
}

}  // namespace gaitmill

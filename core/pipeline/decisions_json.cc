#include "core/pipeline/decisions_json.h"

#include <nlohmann/json.hpp>

#include "core/pipeline/json_fields.h"

namespace gaitmill {

std::string describeAsJson(const Decisions& decisions) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Decision& decision : decisions) {
    list.push_back({{"part", decision.part},
                    {"topic", decision.topic},
                    {"field", decision.field},
                    {"value", decision.value},
                    {"origin", originName(decision.origin)},
                    {"confidence", decision.confidence},
                    {"evidence", decision.evidence}});
  }
  return list.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace gaitmill

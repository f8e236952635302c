#include "service/provenance.h"

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/pipeline/pipeline.h"
#include "service/storage/sha256.h"

namespace gaitmill {

// nlohmann::json keeps the fields of objects sorted and prints the shortest digits that give the
// same double back, on every machine.
std::string renderProvenance(const Provenance& provenance) {
  using nlohmann::json;
  const json settings = json::parse(provenance.settings_json, nullptr, false);
  check(!settings.is_discarded(), "the settings of a job are not JSON");
  return json{{"inputs_sha256", provenance.inputs},
              {"mass_kg", provenance.mass},
              {"height_m", provenance.height},
              {"model_sha256", provenance.model},
              {"marker_set_sha256", provenance.marker_set},
              {"settings", settings},
              {"code", provenance.code}}
      .dump();
}

std::string calcProvenance(const Provenance& provenance) {
  return calcSha256(renderProvenance(provenance));
}

const std::string& sourceVersion() {
  static const std::string version = "gaitmill " + codeVersion();
  return version;
}

}  // namespace gaitmill

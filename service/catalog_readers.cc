#include "service/catalog_readers.h"

#include <vector>

#include <nlohmann/json.hpp>

#include "api/dto/object_reader.h"
#include "core/io/model_table.h"
#include "core/io/osim_reader.h"
#include "core/pipeline/marker_set_json.h"

namespace gaitmill {

namespace {

using nlohmann::json;

template <class Specs>
json listNames(const Specs& specs) {
  json names = json::array();
  for (const auto& spec : specs) {
    names.push_back(spec.name);
  }
  return names;
}

json listCoordinates(const ModelSpec& model) {
  json names = json::array();
  for (const JointSpec& joint : model.joints) {
    for (const CoordinateSpec& coordinate : joint.coordinates) {
      names.push_back(coordinate.name);
    }
  }
  return names;
}

json makeCounts(const ModelSpec& model) {
  const ModelCounts counts = countModel(model);
  return {{"bodies", counts.bodies},
          {"joints", counts.joints},
          {"coordinates", counts.coordinates},
          {"muscles", counts.muscles},
          {"actuators", counts.actuators},
          {"markers", counts.markers}};
}

}  // namespace

std::string summarizeModel(const InputFile& document) {
  std::vector<std::string> warnings;
  const ModelSpec model = readOsim(document.bytes, document.name, &warnings);
  return api::dumpJson({{"name", model.name},
                        {"total_mass_kg", model.calcTotalMass()},
                        {"counts", makeCounts(model)},
                        {"bodies", listNames(model.bodies)},
                        {"coordinates", listCoordinates(model)},
                        {"muscles", listNames(model.muscles)},
                        {"actuators", listNames(model.actuators)},
                        {"markers", listNames(model.markers)},
                        {"warnings", warnings}});
}

std::string summarizeMarkerSet(const InputFile& document) {
  const MarkerSetSpec set = readMarkerSet(document);
  json followed = json::array();
  for (const MarkerWeight& marker : set.ik.markers) {
    if (marker.weight > 0) {
      followed.push_back(marker.marker);
    }
  }
  return api::dumpJson({{"name", set.name},
                        {"description", set.description},
                        {"markers", followed},
                        {"model_markers", listNames(set.markers)}});
}

}  // namespace gaitmill

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

const char* muscleKindName(MuscleKind kind) {
  switch (kind) {
    case MuscleKind::kMillard2012:
      return "millard_2012";
    case MuscleKind::kThelen2003:
      return "thelen_2003";
    case MuscleKind::kSchutte1993:
      return "schutte_1993";
  }
  return "millard_2012";
}

json countMuscleKinds(const ModelSpec& model) {
  json kinds = json::object();
  for (const MuscleSpec& muscle : model.muscles) {
    json& count = kinds[muscleKindName(muscle.kind)];
    count = count.is_null() ? 1 : count.get<int>() + 1;
  }
  return kinds;
}

json makeCounts(const ModelSpec& model) {
  const ModelCounts counts = countModel(model);
  return {{"bodies", counts.bodies},
          {"joints", counts.joints},
          {"coordinates", counts.coordinates},
          {"muscles", counts.muscles},
          {"muscle_kinds", countMuscleKinds(model)},
          {"wrap_objects",
           {{"cylinder", counts.wrap_cylinders},
            {"sphere", counts.wrap_spheres},
            {"ellipsoid", counts.wrap_ellipsoids}}},
          {"passive_forces", counts.passive_forces},
          {"actuators", counts.actuators},
          {"markers", counts.markers}};
}

}  // namespace

std::string summarizeModel(const InputFile& document) {
  std::vector<std::string> warnings;
  const ModelSpec model = readOsim(document.bytes, document.name, &warnings);
  return api::dumpJson({{"name", model.name},
                        {"document_version", model.document_version},
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

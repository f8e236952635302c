#include "core/pipeline/marker_names_json.h"

#include "core/base/error.h"
#include "core/intake/landmarks.h"

namespace gaitmill {

MarkerOverrides readMarkerOverrides(JsonFields fields) {
  MarkerOverrides overrides;
  for (const std::string& measured : fields.names()) {
    if (fields.raw(measured).is_null()) {
      overrides[measured] = std::nullopt;
      continue;
    }
    const std::string landmark = fields.text(measured);
    requireLandmark(landmark, {fields.file(), 0, 0, fields.pathOf(measured)});
    overrides[measured] = landmark;
  }
  return overrides;
}

MarkerOverrides readMarkerNames(const InputFile& file) {
  const nlohmann::json document = parseJson(file);
  return readMarkerOverrides(JsonFields(document, "marker_names", file.name));
}

}  // namespace gaitmill

#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/intake/marker_names.h"
#include "core/pipeline/marker_names_json.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {

// The names of a document as measured markers, and the document as statements about them.
GAITMILL_FUZZ_TARGET(marker_names) {
  const MarkerOverrides stated = readMarkerNames({"fuzz.json", std::string(input)});
  std::vector<std::string> measured;
  for (const auto& [name, landmark] : stated) {
    measured.push_back(name);
  }
  mapMarkerNames(measured);
  mapMarkerNames(measured, stated);
}

}  // namespace gaitmill

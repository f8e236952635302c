#include <string>

#include "core/pipeline/marker_set_json.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {

GAITMILL_FUZZ_TARGET(marker_set) {
  readMarkerSet({"fuzz.json", std::string(input)});
}

}  // namespace gaitmill

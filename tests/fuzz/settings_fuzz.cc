#include <string>

#include "core/pipeline/settings.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {

GAITMILL_FUZZ_TARGET(settings) {
  readSettings({"fuzz.json", std::string(input)});
}

}  // namespace gaitmill

#include <string>

#include "service/config.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {

GAITMILL_FUZZ_TARGET(config) {
  Configuration configuration;
  applyConfigFile(std::string(input), "fuzz.json", configuration);
}

}  // namespace gaitmill

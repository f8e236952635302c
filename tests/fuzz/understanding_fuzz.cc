#include <string>

#include "api/dto/trial.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {

// What an inspection found, as its child process sends it.
GAITMILL_FUZZ_TARGET(understanding) {
  api::TrialView view;
  api::decodeUnderstanding(std::string(input), view);
  api::encodeUnderstanding(view);
}

}  // namespace gaitmill

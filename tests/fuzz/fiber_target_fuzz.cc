#include <cmath>

#include "core/io/fiber_target_reader.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {

GAITMILL_FUZZ_TARGET(fiber_target) {
  tryParse([&] {
    for (const FiberTarget& target : readFiberTargets(input, "fuzz.csv")) {
      requirePromise(!target.muscle.empty() && target.line > 0, "a row names a muscle");
      requirePromise(std::isfinite(target.norm_fiber_length) != std::isfinite(target.fiber_length),
                     "one of the two lengths is given");
      requirePromise(!(target.norm_fiber_length <= 0) && !(target.fiber_length <= 0),
                     "lengths are positive");
    }
  });
}

}  // namespace gaitmill

#include <array>

#include "core/data/expression.h"
#include "tests/fuzz/fuzz_target.h"

namespace gaitmill {

// What was read has a value, which may be none.
GAITMILL_FUZZ_TARGET(expression) {
  const Expression expression(input, {"q", "qdot"});
  const std::array<double, 2> values = {0.3, -1.5};
  static_cast<void>(expression.evaluate(values.data()));
}

}  // namespace gaitmill
